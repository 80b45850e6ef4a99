// What must hold while a target is fuzzed.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

/// Stops the run, which keeps the input, if something does not hold.
inline void must(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "\nFound: %s\n", what.c_str());
  std::abort();
}
