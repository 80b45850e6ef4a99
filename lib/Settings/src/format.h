// A value as text: no printf, no double, the fewest digits that read back as the same float.
#pragma once

#include <stdint.h>

namespace settings {

/// A value as the dump writes it, ended by a zero.
struct ValueText {
  char text[17];
};

/// `value` with 7 to 9 significant digits, as few as give the same float back (always within 1e-7
/// of it), trailing zeros dropped, "0" for zero. Plain decimals from 0.0001 to 999,999,999, else
/// with an exponent, as 5.2e-6. "nan", "inf", "-inf" for what no setting holds.
ValueText formatValue(float value);

}  // namespace settings
