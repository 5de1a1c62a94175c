// Where a table's arrays are. A table owns them; its view, with which device code and combinations draw, points to them, or
// to copies of them that the host has made elsewhere. Both are the same class template over Owned or Viewed.
#pragma once

#include "lumis/core/platform.hpp"

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

namespace lumis::LUMIS_ISA::detail {

template <class Element>
using Owned = std::vector<Element>;

// An array somewhere: trivially copyable, 8 bytes. Its size is known to the table.
template <class Element>
class Viewed {
  public:
    LUMIS_HD constexpr explicit Viewed(std::span<const Element> array) noexcept : data_{array.data()} {}

    [[nodiscard]] LUMIS_HD constexpr const Element* data() const noexcept { return data_; }
    [[nodiscard]] LUMIS_HD constexpr const Element& operator[](std::size_t i) const noexcept { return data_[i]; }

  private:
    const Element* data_;
};

template <template <class> class Array>
concept Owns = std::same_as<Array<char>, Owned<char>>;

// Where a view's arrays are: where the table has them.
struct InPlace {
    template <class Element>
    [[nodiscard]] std::span<const Element> operator()(std::span<const Element> array) const noexcept {
        return array;
    }
};

// A view of an array of the owner, or of what place(array) says is a copy of it.
template <class Element>
[[nodiscard]] Viewed<Element> viewed(const Owned<Element>& array, auto& place) {
    return Viewed<Element>{place(std::span<const Element>{array})};
}

}  // namespace lumis::LUMIS_ISA::detail
