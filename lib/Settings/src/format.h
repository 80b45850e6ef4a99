// A value as text, without printf and double: the fewest digits that read back as the same float.
#pragma once

#include <stdint.h>

namespace settings {

/// A value as the dump writes it, with a zero at the end.
struct ValueText {
  char text[17];
};

/// `value` with 7 to 9 significant digits: the fewest that give the same float back (always within
/// 1e-7 of it), without trailing zeros; "0" for zero. Plain decimals from 0.0001 to 999,999,999,
/// otherwise with an exponent, like 5.2e-6. `value` is finite, as every setting is.
ValueText formatValue(float value);

}  // namespace settings
