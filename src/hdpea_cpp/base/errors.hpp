// SPDX-License-Identifier: GPL-3.0-or-later
// What the core throws, by whose fault it is. The binding maps each to the Python error of the same name.
#pragma once

#include <stdexcept>
#include <string>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// The caller broke the contract of a function: wrong shapes, an index out of range, an illegal option.
struct InvalidArgument : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// The input is well-formed but no surface can be made of it.
struct CannotReconstruct : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The progress callback asked to stop.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled") {}
};

inline void require(bool condition, const std::string& message) {
  if (!condition) throw InvalidArgument(message);
}

/// Reports progress; throws Cancelled when the caller wants to stop. An empty callback is allowed.
inline void report(const Progress& progress, double fraction) {
  if (progress && !progress(fraction)) throw Cancelled();
}

}  // namespace hdpea
