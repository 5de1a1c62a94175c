// Many lights of one type as one strategy: one is selected with a probability in proportion to its weight, and sampled.
//
// A renderer's lights exist once, their strategies at each point to be lit. So `lights` is either a range of strategies or
// a function that makes one as it is asked for, [&](std::size_t i) { return AreaLight{shapes[i], point}; }. The table of
// weights is best made once as well, and passed as it is: nothing is then allocated where light is sampled.
#pragma once

#include "lumis/core/assert.hpp"
#include "lumis/core/detail/held.hpp"
#include "lumis/core/detail/in_lanes.hpp"
#include "lumis/core/detail/spannable.hpp"
#include "lumis/core/platform.hpp"
#include "lumis/core/strategy.hpp"
#include "lumis/core/throw.hpp"
#include "lumis/tables/alias_table.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace lumis::LUMIS_ISA {

namespace detail {

template <class Lights>
[[nodiscard]] LUMIS_HD decltype(auto) light_of(const Lights& lights, std::size_t i) {
    if constexpr (std::invocable<const Lights&, std::size_t>) {
        return lights(i);
    } else {
        return lights[i];
    }
}

}  // namespace detail

// Lights and Table (an AliasTable, a FineAliasTable, a DiscreteTable, or a view of one) may be references, see Held.
template <class Lights, class Table>
class LightSet {
    using Light = std::remove_cvref_t<decltype(detail::light_of(std::declval<const std::remove_cvref_t<Lights>&>(),
                                                                std::size_t{}))>;
    static_assert(Strategy<Light> && !DeltaStrategy<Light>, "lights of a set are strategies with a density");

  public:
    using Scalar = typename Light::Scalar;
    using Point = typename Light::Point;
    using Measure = typename Light::Measure;
    static constexpr int dimensions = std::remove_cvref_t<Table>::dimensions + Light::dimensions;
    using LightSampleType = decltype(std::declval<const Light&>().sample(UniformsOf<Light>{}));

    // A light's own kind of sample; its distance is that to the nearest light of the set, and so is its surface, and its index
    // says which one that is. Only lights know it that are a LightStrategy.
    static constexpr bool knows_nearest = LightStrategy<Light>;
    using SampleType =
        std::conditional_t<knows_nearest, IndexedSample<LightSampleType>,
                           std::conditional_t<detail::DrawsDistance<Light>, Sample<Point, Scalar>, LightSampleType>>;

    static_assert(std::same_as<typename std::remove_cvref_t<Table>::Scalar, Scalar>,
                  "the weights of a light set have its scalar type");

    // weights: a table, or what one is made of; throws as that does, and if a range of lights is of another size.
    // No lights and no weights are an empty set. Device code takes a view of a table, and asserts that the sizes agree.
    template <class Weights>
        requires(!std::is_trivially_destructible_v<Table>)
    LightSet(Lights lights LUMIS_LIFETIME_BOUND, Weights&& weights)
        : lights_{std::forward<Lights>(lights)}, table_{table_of(std::forward<Weights>(weights))} {
        require_same_size();
    }
    // A table that is referred to, or its view.
    LUMIS_HD LightSet(Lights lights LUMIS_LIFETIME_BOUND,
                      std::type_identity_t<Table> weights
                          LUMIS_LIFETIME_BOUND) requires std::is_trivially_destructible_v<Table>
        : lights_{std::forward<Lights>(lights)}, table_{weights} {
        require_same_size();
    }

    // True if no light has a weight above 0: then nothing is drawn.
    [[nodiscard]] LUMIS_HD bool empty() const noexcept { return table_.empty(); }

    // The first uniform selects the light, with a FineAliasTable the first two. Density and distance are those of the whole
    // set, and ask every light for its own: a light may stand before the one selected, and is then the one that is seen.
    [[nodiscard]] LUMIS_HD SampleType sample(glm::vec<dimensions, Scalar> u) const noexcept {
        if constexpr (detail::DrawsDistance<Light> && !knows_nearest) {
            return sample_point(u);
        } else {
            const Selected drawn = sample_one(u);
            SampleType sample{drawn.sample};
            if constexpr (knows_nearest) sample.index = drawn.index;
            if (!(sample.pdf > 0)) return sample;
            sample.pdf = density<Scalar>(sample.value, [&](std::size_t i, const Light& light) {
                if constexpr (knows_nearest) {
                    if (i == drawn.index) return;
                    const LightHit<Scalar> other = detail::hit_in<Scalar>(light, sample.value);
                    if (!(other.distance < sample.distance)) return;
                    sample.distance = other.distance;
                    sample.index = i;
                    if constexpr (detail::HasSurface<SampleType>) sample.surface = other.surface;
                }
            });
            return sample;
        }
    }

    // In lanes each selects its own light and draws it alone; density and distance ask every light for all lanes at once.
    template <RealOf<Scalar> R>
        requires(!std::same_as<R, Scalar>)
    [[nodiscard]] LUMIS_HD auto sample(const glm::vec<dimensions, R>& u) const noexcept {
        using Indices = std::array<std::size_t, R::size>;
        Indices selected;
        auto result = detail::draw_each_lane<LightSet>(u, [&, lane = std::size_t{0}](const auto& alone) mutable {
            const Selected drawn = sample_one(alone);
            selected[lane++] = drawn.index;
            if constexpr (detail::HasDistance<SampleType>) {
                return drawn.sample;
            } else {
                return Sample<Point, Scalar>{Point(drawn.sample.value), static_cast<Scalar>(drawn.sample.pdf)};
            }
        });
        const auto drawn = result.pdf > 0;
        Indices nearest = selected;
        result.pdf = density<R>(result.value, [&](std::size_t i, const Light& light) {
            if constexpr (knows_nearest) {
                const LightHit<R> other = detail::hit_in<R>(light, result.value);
                for (std::size_t lane = 0; lane < R::size; ++lane) {
                    if (i == selected[lane] || !(other.distance[lane] < result.distance[lane])) continue;
                    nearest[lane] = i;
                    result.distance.set(lane, other.distance[lane]);
                    if constexpr (detail::HasSurface<SampleType>)
                        detail::put_lane(result.surface, lane, detail::lane_of(other.surface, lane));
                }
            }
        });
        result.pdf = real::select(drawn, result.pdf, Scalar(0));
        if constexpr (knows_nearest) {
            return IndexedSample<decltype(result), Indices>{result, nearest};
        } else {
            return result;
        }
    }

    // The same but for the distance.
    [[nodiscard]] LUMIS_HD Sample<Point, Scalar> sample_point(glm::vec<dimensions, Scalar> u) const noexcept {
        const auto drawn = sample_one(u).sample;
        return {Point(drawn.value), drawn.pdf > 0 ? pdf(drawn.value) : Scalar(0)};
    }
    template <RealOf<Scalar> R>
        requires(!std::same_as<R, Scalar>)
    [[nodiscard]] LUMIS_HD auto sample_point(const glm::vec<dimensions, R>& u) const noexcept {
        auto result = detail::draw_each_lane<LightSet>(u, [&](const auto& alone) {
            const auto drawn = sample_one(alone).sample;
            return Sample<Point, Scalar>{Point(drawn.value), static_cast<Scalar>(drawn.pdf)};
        });
        const R whole = density<R>(result.value, [](std::size_t, const Light&) {});
        result.pdf = real::select(result.pdf > 0, whole, Scalar(0));
        return result;
    }

    [[nodiscard]] LUMIS_HD Scalar pdf(const Point& x) const noexcept {
        return density<Scalar>(x, [](std::size_t, const Light&) {});
    }
    template <detail::PointInLanes<LightSet> X>
    [[nodiscard]] LUMIS_HD auto pdf(const X& x) const noexcept {
        return density<typename detail::RealAt<LightSet, X>::type>(x, [](std::size_t, const Light&) {});
    }

    // To the nearest light of the set; infinity where there is none.
    [[nodiscard]] LUMIS_HD Scalar distance_along(const Point& w) const noexcept requires LightStrategy<Light> {
        return nearest<Scalar>(w);
    }
    template <detail::PointInLanes<LightSet> X>
        requires LightStrategy<Light>
    [[nodiscard]] LUMIS_HD auto distance_along(const X& w) const noexcept {
        return nearest<typename detail::RealAt<LightSet, X>::type>(w);
    }

    // The same, and what stands there.
    [[nodiscard]] LUMIS_HD LightHit<Scalar> hit_along(const Point& w) const noexcept requires SurfaceStrategy<Light> {
        return nearest_hit<Scalar>(w);
    }
    template <detail::PointInLanes<LightSet> X>
        requires SurfaceStrategy<Light>
    [[nodiscard]] LUMIS_HD auto hit_along(const X& w) const noexcept {
        return nearest_hit<typename detail::RealAt<LightSet, X>::type>(w);
    }

    // For hosts to which each light is an integral of its own, told apart from what another draws in the same direction:
    // the index of the light selected, and its sample with the density that counts the selection and the distance to this
    // light. In constant time.
    struct Selected {
        std::size_t index{};
        LightSampleType sample{};
    };
    [[nodiscard]] LUMIS_HD Selected sample_one(glm::vec<dimensions, Scalar> u) const noexcept {
        constexpr int selecting = dimensions - Light::dimensions;
        glm::vec<selecting, Scalar> first;
        for (int i = 0; i < selecting; ++i) first[i] = u[i];
        const auto selected = table_.sample(first);
        if (!(selected.pdf > 0)) return {};
        UniformsOf<Light> rest;
        for (int i = 0; i < Light::dimensions; ++i) rest[i] = u[selecting + i];
        auto sample = light(selected.value).sample(rest);
        sample.pdf *= selected.pdf;
        return {selected.value, sample};
    }
    [[nodiscard]] LUMIS_HD Scalar pdf_of(std::size_t index, const Point& x) const noexcept {
        const Scalar selected = table_.pdf(index);  // 0 for an index that is none, of which no light must be made
        return selected > 0 ? selected * static_cast<Scalar>(light(index).pdf(x)) : Scalar(0);
    }
    // The same where the host knows where a ray hit light `index`, see AreaLight::pdf_from_hit.
    [[nodiscard]] LUMIS_HD Scalar pdf_of_hit(std::size_t index, Scalar distance,
                                             Scalar cos_light) const noexcept requires requires(const Light& light) {
        light.pdf_from_hit(distance, cos_light);
    }
    { return table_.pdf(index) * light(index).pdf_from_hit(distance, cos_light); }
    // How far away light `index` is along w; infinity where w misses it, and for an index that is none.
    [[nodiscard]] LUMIS_HD Scalar distance_of(std::size_t index,
                                              const Point& w) const noexcept requires LightStrategy<Light> {
        return index < table_.size() ? light(index).distance_along(w) : std::numeric_limits<Scalar>::infinity();
    }

  private:
    LUMIS_HD void require_same_size() const {
        if constexpr (requires { std::size(lights_); }) {
            const std::size_t count = std::size(lights_);
            const bool agree = count == table_.size() || (count == 0 && table_.empty());
#ifdef __CUDA_ARCH__
            LUMIS_ASSERT(agree);
#else
            if (!agree) {
                detail::refuse("lumis: " + std::to_string(count) + " lights got " + std::to_string(table_.size()) +
                               " weights");
            }
#endif
        }
    }

    // A table has at least one weight: that of an empty set is 0.
    template <class Weights>
    static decltype(auto) table_of(Weights&& weights) {
        if constexpr (std::same_as<std::remove_cvref_t<Weights>, std::remove_cvref_t<Table>>) {
            return std::forward<Weights>(weights);
        } else {
            constexpr Scalar none[] = {Scalar(0)};
            return std::empty(weights) ? Table{none} : Table{weights};
        }
    }

    // The density of the whole set; visit(i, light) is called with each light that has a share in it.
    template <Real R, class X, class Visit>
    [[nodiscard]] LUMIS_HD R density(const X& x, Visit visit) const noexcept {
        R sum = scalar_of<R>(0);
        for (std::size_t i = 0; i < table_.size(); ++i) {
            const Scalar selected = table_.pdf(i);
            if (!(selected > 0)) continue;
            const auto& one = light(i);
            sum += selected * detail::pdf_in<R>(one, x);
            visit(i, one);
        }
        return density_or_zero(sum);
    }

    template <Real R, class X>
    [[nodiscard]] LUMIS_HD R nearest(const X& w) const noexcept {
        R nearest = std::numeric_limits<scalar_of<R>>::infinity();
        for (std::size_t i = 0; i < table_.size(); ++i) {
            if (table_.pdf(i) > 0) nearest = real::lesser(nearest, detail::distance_in<R>(light(i), w));
        }
        return nearest;
    }

    template <Real R, class X>
    [[nodiscard]] LUMIS_HD LightHit<R> nearest_hit(const X& w) const noexcept {
        LightHit<R> nearest;
        for (std::size_t i = 0; i < table_.size(); ++i) {
            if (table_.pdf(i) > 0) detail::keep_nearer(nearest, detail::hit_in<R>(light(i), w));
        }
        return nearest;
    }

    [[nodiscard]] LUMIS_HD decltype(auto) light(std::size_t index) const {
        return detail::light_of(lights_, index);
    }

    Lights lights_;
    Table table_;
};

// Weights become a table; a table is used as it is.
template <class Lights, detail::Spannable Weights>
LightSet(Lights&&, Weights&&) -> LightSet<detail::Held<Lights>, AliasTable<detail::ElementOf<Weights>>>;
template <class Lights, class Table>
LightSet(Lights&&, Table&&) -> LightSet<detail::Held<Lights>, detail::Held<Table>>;

}  // namespace lumis::LUMIS_ISA
