// Tables of one size, a row each, drawn by inverting their cumulative counts (see cumulative_counts.hpp): monotone, so
// that the uniforms' stratification is kept, and invertible. The search is indexed (Chen and Asau 1974): the counts are
// divided into equal runs, and a guide tells in which entry each run begins; the search goes on from there. It is a short
// scan with branches. Processors guess those and read ahead, which in large tables was faster than every search without
// branches that we tried.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/tables/detail/arrays.hpp"
#include "lumis/tables/detail/cumulative_counts.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace lumis::LUMIS_ISA::detail {

// Elements of arrays are not initialised, so that the threads that deal the rows are the first to touch their memory.
struct RunStart {
    RunStart() noexcept {}
    std::uint32_t value;
};
struct GuideEntry {
    GuideEntry() noexcept {}
    std::uint16_t value;
};

template <class T, template <class> class Array = Owned>
class GuidedRows {
  public:
    using Scalar = T;

    // `rows` tables of `entries` weights. Keeps 6 bytes a weight, and 6 more a row.
    GuidedRows(std::size_t entries, std::size_t rows)
        : entries_{entries},
          guide_shift_{entries > 0x10000 ? static_cast<int>(std::bit_width(entries - 1)) - 16 : 0},
          starts_(rows * (entries_ + 1)),
          guide_(rows * (entries_ + 1)) {}

    // A view of the owner's arrays where place puts them, see viewed.
    GuidedRows(const GuidedRows<T, Owned>& owner, auto& place)
        : entries_{owner.entries_},
          guide_shift_{owner.guide_shift_},
          starts_{viewed(owner.starts_, place)},
          guide_{viewed(owner.guide_, place)} {}

    [[nodiscard]] LUMIS_HD std::size_t entries() const noexcept { return entries_; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept {
        return starts_.size() * sizeof(RunStart) + guide_.size() * sizeof(GuideEntry);
    }

    // Sets one row; different rows may be dealt at the same time. The weights are overwritten.
    Dealt deal(std::size_t row, std::span<double> weights) {
        RunStart* const starts = &starts_[row * (entries_ + 1)];
        const Dealt dealt = deal_counts<T>(weights, [&](std::size_t i) -> std::uint32_t& { return starts[i].value; });
        starts[entries_].value = total_counts<T>;
        fill_guide(starts, &guide_[row * (entries_ + 1)]);
        return dealt;
    }

    // u in [0, 1]. An entry of weight 0 is never drawn.
    [[nodiscard]] LUMIS_HD DrawnEntry<T> draw(std::size_t row, T u) const noexcept {
        const auto [count, within] = lattice_point(u);
        const RunStart* const starts = starts_.data() + row * (entries_ + 1);
        const std::size_t run = (std::uint64_t{count} * entries_) >> count_bits<T>;
        const GuideEntry* const guide = guide_.data() + row * (entries_ + 1) + run;
#if defined(__GNUC__) && !defined(__CUDA_ARCH__)
        __builtin_prefetch(starts + run);  // where an evenly lit row has it
#endif
        // The entry drawn, the last one that starts at or before the count, lies between where this run begins and where
        // the next one does: a few entries, unless many small ones share a run, or a wide table's guide tells only groups.
        std::size_t entry = std::size_t{guide[0].value} << guide_shift_;
        const std::size_t end = (std::size_t{guide[1].value} + 1) << guide_shift_;
        std::size_t last = (end < entries_ ? end : entries_) - 1;
        while (last - entry > 16) {
            const std::size_t middle = (entry + last) / 2;
            (starts[middle].value <= count ? entry : last) = middle;
        }
        while (starts[entry + 1].value <= count) ++entry;
        const std::uint32_t start = starts[entry].value, counts = starts[entry + 1].value - start;
        return {entry, counts, real::divide(static_cast<T>(count - start) + within, static_cast<T>(counts))};
    }

    // The number of counts of an entry.
    [[nodiscard]] LUMIS_HD std::uint32_t counts(std::size_t row, std::size_t i) const noexcept {
        return start(row, i + 1) - start(row, i);
    }

    // The uniform that draws an entry at a position within its run: the inverse of draw.
    [[nodiscard]] LUMIS_HD T uniform_of(std::size_t row, std::size_t i, T position) const noexcept {
        return (static_cast<T>(start(row, i)) + position * static_cast<T>(counts(row, i))) /
               static_cast<T>(total_counts<T>);
    }

  private:
    template <class, template <class> class>
    friend class GuidedRows;

    // Sets a row's guide. Run r begins with the count ceil(r total_counts / entries), so that the first run which begins at
    // or behind a start s is floor((s - 1) entries / total_counts) + 1. Each entry puts itself down there, over those that
    // start at the same count and so have none, and is carried on to where the next one stands.
    void fill_guide(const RunStart* starts, GuideEntry* guide) const noexcept {
        for (std::size_t run = 0; run < entries_; ++run) guide[run].value = 0;
        for (std::size_t entry = 0; entry < entries_; ++entry) {
            const std::uint64_t scaled = starts[entry].value * std::uint64_t{entries_} + (total_counts<T> - entries_);
            guide[scaled >> count_bits<T>].value = static_cast<std::uint16_t>(entry >> guide_shift_);
        }
        std::uint16_t latest = 0;
        for (std::size_t run = 0; run < entries_; ++run) {
            latest = guide[run].value > latest ? guide[run].value : latest;
            guide[run].value = latest;
        }
        // Behind the runs stands the last entry that is drawn.
        std::size_t last = entries_ - 1;
        while (starts[last].value == total_counts<T>) --last;
        guide[entries_].value = static_cast<std::uint16_t>(last >> guide_shift_);
    }

    [[nodiscard]] LUMIS_HD std::uint32_t start(std::size_t row, std::size_t i) const noexcept {
        return starts_[row * (entries_ + 1) + i].value;
    }

    std::size_t entries_;
    int guide_shift_;          // of tables beyond 2^16 entries
    Array<RunStart> starts_;   // the number of counts before each entry, and behind the last one
    Array<GuideEntry> guide_;  // the group of entries in which each run begins, and the last one drawn
};

}  // namespace lumis::LUMIS_ISA::detail
