// SPDX-License-Identifier: GPL-3.0-or-later
// Plain values in the byte strings of the store, in the machine's order (little-endian, asserted in chunk.cpp).
#pragma once

#include <cstring>
#include <string>
#include <string_view>

namespace seaway::store {

template <class T>
void put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The value at `at`, which moves behind it. The caller has looked at the length.
template <class T>
T get(std::string_view bytes, std::size_t& at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  at += sizeof value;
  return value;
}

}  // namespace seaway::store
