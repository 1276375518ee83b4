#pragma once
#include <cassert>
#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace dstylize {

/// Size of a 2D (z == 1) or 3D block of samples.
struct Extent {
    int x = 0, y = 0, z = 1;
    std::size_t count() const { return std::size_t(x) * std::size_t(y) * std::size_t(z); }
    int long_side() const { return x > y ? x : y; }
    bool contains(int i, int j, int k = 0) const { return i >= 0 && j >= 0 && k >= 0 && i < x && j < y && k < z; }
    friend bool operator==(const Extent&, const Extent&) = default;
};

/// std::allocator, but what is made without a value has none yet: fresh memory stays untouched until it is written.
template <class T>
struct UnsetAllocator : std::allocator<T> {
    // NOLINTBEGIN(readability-identifier-naming): the standard's names
    template <class U>
    struct rebind {
        using other = UnsetAllocator<U>;
    };
    // NOLINTEND(readability-identifier-naming)
    template <class U>
    void construct(U* at) {
        ::new (static_cast<void*>(at)) U;
    }
    template <class U, class... Args>
    void construct(U* at, Args&&... args) {
        ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
    }
};

/// A vector that can have values that are not set yet: resize() leaves them to who sets all of them. On several
/// threads, if they are many: most of what a large array costs falls to who first touches its memory.
template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

/// Dense samples, x fastest, then y, then z. Owns its memory; a copy is deep.
template <class T>
class Grid {
  public:
    Grid() = default;
    explicit Grid(Extent extent, T fill = {}) : extent_(extent), samples_(extent.count(), fill) {}

    /// Samples that have no value yet, as in an UnsetVector.
    static Grid unset(Extent extent) {
        Grid out;
        out.extent_ = extent;
        out.samples_.resize(extent.count());
        return out;
    }

    Extent extent() const { return extent_; }
    std::size_t size() const { return samples_.size(); }
    bool empty() const { return samples_.empty(); }
    T& operator()(int i, int j, int k = 0) { return samples_[offset(i, j, k)]; }
    const T& operator()(int i, int j, int k = 0) const { return samples_[offset(i, j, k)]; }
    T& operator[](std::size_t n) { return samples_[n]; }
    const T& operator[](std::size_t n) const { return samples_[n]; }
    T* data() { return samples_.data(); }
    const T* data() const { return samples_.data(); }
    const T* row(int j) const { return data() + std::size_t(j) * std::size_t(extent_.x); }
    T* row(int j) { return data() + std::size_t(j) * std::size_t(extent_.x); }
    auto begin() { return samples_.begin(); }
    auto end() { return samples_.end(); }
    auto begin() const { return samples_.begin(); }
    auto end() const { return samples_.end(); }
    friend bool operator==(const Grid&, const Grid&) = default;

  private:
    std::size_t offset(int i, int j, int k) const {
        assert(extent_.contains(i, j, k));
        return (std::size_t(k) * std::size_t(extent_.y) + std::size_t(j)) * std::size_t(extent_.x) + std::size_t(i);
    }
    Extent extent_;
    UnsetVector<T> samples_;
};

}  // namespace dstylize
