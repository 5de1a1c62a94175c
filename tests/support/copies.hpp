// Copies of a table's arrays, as a host makes them in a device's memory: bytes, and a span of them.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

class Copies {
  public:
    template <class Element>
    std::span<const Element> operator()(std::span<const Element> array) {
        static_assert(std::is_trivially_copyable_v<Element>);
        auto& bytes = arrays_.emplace_back(std::make_unique<std::byte[]>(array.size_bytes()));
        std::memcpy(bytes.get(), array.data(), array.size_bytes());
        return {reinterpret_cast<const Element*>(bytes.get()), array.size()};
    }

    [[nodiscard]] std::size_t size() const { return arrays_.size(); }

  private:
    std::vector<std::unique_ptr<std::byte[]>> arrays_;
};
