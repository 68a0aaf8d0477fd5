// SPDX-License-Identifier: Apache-2.0
// A list of at most N elements in place: it needs no memory of its own.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

namespace halfway {

/// T must be default-constructible. The caller adds at most N elements.
template <class T, std::size_t N>
class FixedVector {
 public:
  void push_back(const T& element) {
    assert(size_ < N);
    elements_[size_++] = element;
  }
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return elements_.data(); }
  const T* data() const { return elements_.data(); }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T& operator[](std::size_t i) { return elements_[i]; }
  const T& operator[](std::size_t i) const { return elements_[i]; }
  const T& front() const { return elements_[0]; }
  const T& back() const { return elements_[size_ - 1]; }

 private:
  std::array<T, N> elements_;
  std::size_t size_ = 0;
};

}  // namespace halfway
