// SPDX-License-Identifier: Apache-2.0
// Values of recently used keys.
#pragma once

#include <cstddef>
#include <memory>

namespace halfway {

/// A table with one place per hash. A new key replaces the key at its place. A default-constructed Key is no
/// key. `key.hash()` need not be reduced to the size.
template <class Key, class Value, std::size_t Size>
class RecentValues {
 public:
  /// The value of the key, by make() if the table has none. It is valid until the next call.
  template <class Make>
  const Value& get(const Key& key, Make&& make) {
    Entry& entry = entries_[key.hash() % Size];
    if (!(entry.key == key)) entry = {key, make()};
    return entry.value;
  }

 private:
  struct Entry {
    Key key;
    Value value;
  };
  std::unique_ptr<Entry[]> entries_ = std::make_unique<Entry[]>(Size);
};

}  // namespace halfway
