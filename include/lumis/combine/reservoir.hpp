// One item of a stream, kept with a probability in proportion to its weight: weighted reservoir sampling (Chao 1982, "A general
// purpose unequal probability sampling plan"). The stream may be of any length, the memory is that of one item.
#pragma once

#include "lumis/combine/detail/select_item.hpp"
#include "lumis/combine/detail/sum_of_weights.hpp"
#include "lumis/combine/heuristics.hpp"
#include "lumis/core/assert.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/real.hpp"

#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

namespace detail {

// A sample is weighed in the type of its density, anything else in float.
template <class Item>
struct WeightOf : std::type_identity<float> {};
template <class Item>
    requires requires(const Item item) {
        item.pdf;
    }
struct WeightOf<Item> : std::type_identity<std::remove_cvref_t<decltype(std::declval<const Item&>().pdf)>> {};

// What decides among weights of type R: a uniform of that type or, where these are floats, of more digits.
template <class U, class R>
concept DecidesFor = std::same_as<U, R> ||(std::floating_point<R>&& FloatOrDouble<U>);

}  // namespace detail

// R is the type of the weights. In lanes each lane keeps an item of its own; items then are samples in lanes, points in lanes,
// or of a type that offers select(condition, a, b). Trivially copyable if Item is.
//
// A weight that is NaN, infinite or negative counts as 0, and so does one that would bring their sum beyond half of the largest
// number; each fails an assertion. An item of weight 0 is never kept.
template <class Item, Real R = typename detail::WeightOf<Item>::type>
class Reservoir {
    using Scalar = scalar_of<R>;
    using Sum = detail::SumOfWeights<R>;
    using Wide = typename Sum::Value;  // a selection is decided in the precision of the sum

  public:
    // Keeps the item, in place of the one before, if u in [0, 1) lies below its share of all weights; 1 is tolerated. Returns
    // whether it does. u is a fresh uniform. The first item of a positive weight is kept whatever u is, unless the weight is a
    // subnormal double.
    //
    // A uniform of float has steps of 2^-24, which favours an item over those before it by half a step, on average. For more than
    // 10^5 items give a double.
    //
    // stands_for: how many candidates the item was selected from, for count() alone.
    template <detail::DecidesFor<R> U>
    LUMIS_INLINE MaskOf<R> add(const Item& item, std::type_identity_t<R> weight, const U& u,
                               std::uint64_t stands_for = 1) noexcept {
        U unused = u;
        return add<false>(item, weight, unused, stands_for);
    }

    // The same, and u becomes a uniform that is as good as a fresh one but for its digits: it loses as many bits as the
    // selection among all items takes. For hosts that are short of numbers, as low-discrepancy points are of dimensions.
    template <detail::DecidesFor<R> U>
    LUMIS_INLINE MaskOf<R> add_reusing(const Item& item, std::type_identity_t<R> weight, U& u,
                                       std::uint64_t stands_for = 1) noexcept {
        return add<true>(item, weight, u, stands_for);
    }

    // As if all items of `other` had been added here, at the cost of one.
    template <detail::DecidesFor<R> U>
    LUMIS_INLINE MaskOf<R> merge(const Reservoir& other, const U& u) noexcept {
        U unused = u;
        count_ += other.count_;
        const R weight = accepted(other.total_weight());
        if (real::all(weight == other.total_weight())) [[likely]] {
            total_.add(other.total_);
        } else {
            total_.add(Wide(weight));
        }
        return select<false>(other.item_, Wide(weight), other.weight_, unused);
    }

    // The item that is kept, and its weight; a weight of 0: there is none.
    [[nodiscard]] LUMIS_HD constexpr const Item& item() const noexcept LUMIS_LIFETIME_BOUND { return item_; }
    [[nodiscard]] LUMIS_HD constexpr const R& weight() const noexcept LUMIS_LIFETIME_BOUND { return weight_; }

    // The sum of all weights, as of numbers in double: 10^8 small ones lose no digit of a float.
    [[nodiscard]] LUMIS_HD constexpr R total_weight() const noexcept { return static_cast<R>(total_.value()); }

    // How many items were added, those of weight 0 too.
    [[nodiscard]] LUMIS_HD constexpr std::uint64_t count() const noexcept { return count_; }

    // total_weight() / weight(), over the probability with which the item was kept: exactly 1 if no other item has a weight, 0
    // if there is none.
    [[nodiscard]] LUMIS_HD constexpr R inverse_probability() const noexcept {
        return static_cast<R>(real::quotient_where(weight_ > 0, total_.value(), Wide(weight_)));
    }

    // What an integrand at the item is multiplied by, where the weight of each item x was m(x) target(x) / pdf(x) with MIS
    // weights m that sum to 1 over the candidates: total_weight() / target. 0 if no item was kept, or the target is 0.
    [[nodiscard]] LUMIS_HD constexpr R contribution_weight(std::type_identity_t<R> target) const noexcept {
        return static_cast<R>(real::quotient_where(weight_ > 0 && target > 0, total_.value(), Wide(target)));
    }

  private:
    template <bool reuse, class U>
    LUMIS_INLINE MaskOf<R> add(const Item& item, const R& any_weight, U& u, std::uint64_t stands_for) noexcept {
        count_ += stands_for;
        const R weight = accepted(any_weight);
        total_.add(Wide(weight));
        return select<reuse>(item, Wide(weight), weight, u);
    }

    // The weight if it is one, else 0.
    [[nodiscard]] LUMIS_INLINE R accepted(const R& weight) const noexcept {
        const MaskOf<R> good = weight >= 0 && total_.value() + Wide(weight) <= Wide(detail::largest_sum<Scalar>);
        LUMIS_ASSERT(real::all(good));
        return real::select(good, weight, Scalar(0));
    }

    // Keeps the item of weight `own` with the probability that `part` has of the total, which includes it.
    template <bool reuse, class U>
    LUMIS_INLINE MaskOf<R> select(const Item& item, const Wide& part, const R& own, U& u) noexcept {
        // Below 1: what is all of the total is kept for certain. Above 0: what is next to nothing of it never is, although u may
        // be 0, so that inverse_probability() does not overflow.
        constexpr scalar_of<Wide> least = 0x1p-64f, most = 1 - std::numeric_limits<scalar_of<Wide>>::epsilon() / 2;
        const Wide all = total_.value(), chance = real::clamp(static_cast<Wide>(u), Wide(least), Wide(most));
        const MaskOf<R> selected = chance * all < part;
        if constexpr (reuse) {
            const Wide share = real::divide(part, real::divisor_where(all > 0, all));
            const Wide taken = real::divide(chance, real::divisor_where(selected, share));
            const Wide left = real::divide(Wide(chance - share), real::divisor_where(!selected, Wide(1 - share)));
            u = static_cast<U>(real::select(selected, taken, left));
        }
        weight_ = real::select(selected, own, weight_);
        if (real::any(selected)) item_ = detail::select_item(selected, item, item_);
        return selected;
    }

    Item item_{};
    R weight_ = Scalar(0);
    Sum total_;
    std::uint64_t count_ = 0;
};

}  // namespace lumis::LUMIS_ISA
