// Tables of one size, a row each, drawn by the alias method (Walker 1977) in fixed point: bins and entries are whole numbers
// of counts (see cumulative_counts.hpp), so that the reported counts are the ones drawn. A draw takes constant time and
// nearly always reads one bin. It is not monotone: neighbouring uniforms may draw entries far apart, and there is no
// inverse.
//
// The total_counts<T> counts are divided into as many bins as there are entries, of equal size but for one count. Bin i holds
// counts of entry i first, and then counts of another entry, its alias:
//
//     bin i   | own counts: draw i | the rest: draw the alias |      0 < own < size of the bin, or own = 0
//
// An entry with fewer counts than its bin is light: all of its counts are in its own bin. A heavy entry fills up the bins of
// light ones and of other heavy ones; what is left of it at last stands in its own bin. A heavy entry that fills its bin
// alone is stored as its own alias, with no own counts.
#pragma once

#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"
#include "lumis/tables/detail/arrays.hpp"
#include "lumis/tables/detail/cumulative_counts.hpp"

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lumis::LUMIS_ISA::detail {

//     own_and_alias    | alias: the other bits | own counts: the low own_bits_ |
//     heavy_and_kind   | light: bit 31 | counts of the heavy entry, less 1: bits 0 to 30 |
// The heavy entry is the bin's own, or a light bin's alias.
struct AliasBin {
    AliasBin() noexcept {}
    AliasBin(std::uint32_t own_and_alias_, std::uint32_t heavy, bool light) noexcept
        : own_and_alias{own_and_alias_}, heavy_and_kind{(heavy - 1) | (light ? light_bit : 0)} {}

    static constexpr std::uint32_t light_bit = std::uint32_t{1} << 31;
    [[nodiscard]] LUMIS_HD bool is_light() const noexcept { return heavy_and_kind >= light_bit; }
    [[nodiscard]] LUMIS_HD std::uint32_t heavy_counts() const noexcept { return (heavy_and_kind & ~light_bit) + 1; }

    std::uint32_t own_and_alias, heavy_and_kind;
};

template <class T, template <class> class Array = Owned>
class AliasRows {
  public:
    using Scalar = T;

    // `rows` tables of `entries` weights. Keeps 8 bytes a weight.
    AliasRows(std::size_t entries, std::size_t rows)
        : entries_{entries},
          capacity_{static_cast<std::uint32_t>(total_counts<T> / entries)},
          larger_bins_{static_cast<std::uint32_t>(total_counts<T> % entries)},
          own_bits_{static_cast<int>(std::bit_width(capacity_ - (larger_bins_ == 0)))},
          division_shift_{count_bits<T> + static_cast<int>(std::bit_width(entries - 1))},
          reciprocal_{((std::uint64_t{1} << division_shift_) + entries - 1) / entries},
          bins_(rows * entries) {}

    // A view of the owner's arrays where place puts them, see viewed.
    AliasRows(const AliasRows<T, Owned>& owner, auto& place)
        : entries_{owner.entries_},
          capacity_{owner.capacity_},
          larger_bins_{owner.larger_bins_},
          own_bits_{owner.own_bits_},
          division_shift_{owner.division_shift_},
          reciprocal_{owner.reciprocal_},
          bins_{viewed(owner.bins_, place)} {}

    [[nodiscard]] LUMIS_HD std::size_t entries() const noexcept { return entries_; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return bins_.size() * sizeof(AliasBin); }

    // Sets one row; different rows may be dealt at the same time. The weights are overwritten.
    Dealt deal(std::size_t row, std::span<double> weights) {
        std::vector<std::uint32_t> counts(entries_ + 1, total_counts<T>);
        const Dealt dealt = deal_counts<T>(weights, [&](std::size_t i) -> std::uint32_t& { return counts[i]; });
        for (std::size_t i = 0; i < entries_; ++i) counts[i] = counts[i + 1] - counts[i];
        fill(bins_.data() + row * entries_, counts);
        return dealt;
    }

    // u in [0, 1]. An entry of weight 0 is never drawn.
    [[nodiscard]] LUMIS_HD DrawnEntry<T> draw(std::size_t row, T u) const noexcept {
        // 1. The bin that holds the count: floor(count entries / total_counts).
        const auto [count, within] = lattice_point(u);
        const std::uint64_t scaled = std::uint64_t{count} * entries_;
        const auto index = static_cast<std::size_t>(scaled >> count_bits<T>);
        // 2. The count's place in the bin: floor(remainder / entries), by multiplication (Granlund and Montgomery 1994).
        const std::uint64_t remainder = scaled & (total_counts<T> - 1);
        const auto place = static_cast<std::uint32_t>((remainder * reciprocal_) >> division_shift_);

        // 3. The entry: the bin's own, or its alias.
        const AliasBin* const bins = bins_.data() + row * entries_;
        const AliasBin bin = bins[index];
        const std::uint32_t own = bin.own_and_alias & own_mask();
        const std::size_t alias = bin.own_and_alias >> own_bits_;
        const bool is_own = place < own, light = bin.is_light();
        const std::size_t drawn = is_own ? index : alias;
        // 4. Its counts. Those of a light bin's alias are stored in the bin; else the drawn entry is heavy and stores them.
        const std::uint32_t heavy_counts = bins[light ? index : drawn].heavy_counts();
        // 5. Where the count lies within this run of the entry's counts.
        const std::uint32_t larger = remainder - place * entries_ < larger_bins_;  // the bin holds one more
        const std::uint32_t begin = is_own ? 0 : own, end = is_own ? own : capacity_ + larger;
        return {drawn, is_own && light ? own : heavy_counts,
                real::divide(static_cast<T>(place - begin) + within, static_cast<T>(end - begin))};
    }

    // The number of counts of an entry. A branch on its kind, which processors guess where neighbours are mostly of one: in
    // an environment map.
    [[nodiscard]] LUMIS_HD std::uint32_t counts(std::size_t row, std::size_t i) const noexcept {
        const AliasBin bin = bins_[row * entries_ + i];
        return bin.is_light() ? bin.own_and_alias & own_mask() : bin.heavy_counts();
    }

    // The same without a branch, for weights in no order: half of the guesses would be wrong, which takes g++'s branch from 1
    // to 5 ns.
    [[nodiscard]] LUMIS_HD std::uint32_t counts_unguessed(std::size_t row, std::size_t i) const noexcept {
        const AliasBin bin = bins_[row * entries_ + i];
        const std::uint32_t own = bin.own_and_alias & own_mask(), heavy = bin.heavy_counts();
        return heavy ^ ((heavy ^ own) & (0 - std::uint32_t{bin.is_light()}));
    }

  private:
    template <class, template <class> class>
    friend class AliasRows;

    [[nodiscard]] LUMIS_HD std::uint32_t own_mask() const noexcept { return (std::uint32_t{1} << own_bits_) - 1; }

    // The counts of a bin: those from ceil(bin total_counts / entries) on.
    [[nodiscard]] std::uint32_t capacity(std::size_t bin) const noexcept {
        if (larger_bins_ == 0) return capacity_;
        const auto extra = [&](std::uint64_t i) { return (i * larger_bins_ + entries_ - 1) / entries_; };
        return capacity_ + static_cast<std::uint32_t>(extra(bin + 1) - extra(bin));
    }

    // Sets the bins of a row. One index sweeps over the light entries and one over the heavy ones (Huebschle-Schneider and
    // Sanders 2022, "Parallel Weighted Random Sampling"): no lists are needed, and the same heavy entry fills neighbouring
    // bins.
    void fill(AliasBin* bins, std::span<const std::uint32_t> counts) const noexcept {
        const auto packed = [&](std::uint32_t own, std::size_t alias) {
            return static_cast<std::uint32_t>(alias << own_bits_) | own;
        };
        const auto next = [&](std::size_t i, bool light) {
            while (i < entries_ && (counts[i] < capacity(i)) != light) ++i;
            return i;
        };
        std::size_t light = next(0, true), heavy = next(0, false);
        std::uint32_t left = counts[heavy];  // of the heavy entry
        while (heavy < entries_) {
            const std::uint32_t room = capacity(heavy);
            // While the heavy entry does not fit into its own bin, it fills up light ones.
            for (; left > room; light = next(light + 1, true)) {
                left -= capacity(light) - counts[light];
                bins[light] = AliasBin{packed(counts[light], heavy), counts[heavy], true};
            }
            // Then the rest of it goes there, and the next heavy entry fills up what remains. A full bin is stored as its own
            // alias: own_bits_ do not hold so many own counts.
            const std::size_t other = next(heavy + 1, false);
            bins[heavy] = AliasBin{left < room ? packed(left, other) : packed(0, heavy), counts[heavy], false};
            if (other < entries_) left = counts[other] - (room - left);
            heavy = other;
        }
    }

    std::size_t entries_;
    std::uint32_t capacity_, larger_bins_;  // counts of a bin, of which so many hold one more
    int own_bits_, division_shift_;
    std::uint64_t reciprocal_;
    Array<AliasBin> bins_;
};

}  // namespace lumis::LUMIS_ISA::detail
