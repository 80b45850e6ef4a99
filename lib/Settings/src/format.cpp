// The decimal digits of a float, by whole-number arithmetic.
#include "format.h"

#include "bytes.h"

namespace settings {

namespace {

const uint8_t kMostDigits = 9;           // enough to distinguish any two floats
const uint8_t kFewestDigits = 7;         // as many as the clients need
const uint32_t kNineDigits = 100000000;  // the smallest number of nine digits

/// A positive number: mantissa * 2^binary * 10^-decimal.
struct Scaled {
  uint64_t mantissa;
  int16_t binary, decimal;
};

/// A float's digits, and by how much they may change before another float is nearer.
struct Digits {
  uint32_t quarters;  ///< of the ninth digit: 4 * kNineDigits up to less than ten times that
  uint32_t room;      ///< half of the step to the next float, in quarters
  int16_t exponent;   ///< the first digit stands for 10^exponent
};

// Forty multiplications leave at least 56 correct bits, far more than nine digits need.
Scaled timesTen(Scaled s) {
  s.mantissa *= 10;
  while (s.mantissa >> 60) {
    s.mantissa >>= 1;
    ++s.binary;
  }
  ++s.decimal;
  return s;
}

/// mantissa / 10 = 0.8 * mantissa / 8, where 0.8 = 0.11001100... in binary.
Scaled overTen(Scaled s) {
  uint64_t part = (s.mantissa >> 1) + (s.mantissa >> 2);
  part += part >> 4;
  part += part >> 8;
  part += part >> 16;
  part += part >> 32;
  s.mantissa = part;
  s.binary -= 3;
  while (!(s.mantissa >> 59)) {
    s.mantissa <<= 1;
    --s.binary;
  }
  --s.decimal;
  return s;
}

/// The number in quarters, rounded; right for binary exponents of -33 to -30.
uint32_t quartersOf(const Scaled& s) {
  return uint32_t(((s.mantissa >> (-s.binary - 3)) + 1) >> 1);
}

// A mantissa is at least 2^59, so nine digits need a binary exponent of -33 to -30.
bool isTooSmall(const Scaled& s) { return s.binary < -33 || quartersOf(s) < 4 * kNineDigits; }
bool isTooLarge(const Scaled& s) {
  return s.binary > -30 || (s.binary >= -33 && quartersOf(s) >= 40 * kNineDigits);
}

Digits digitsOf(uint32_t bits) {
  const uint8_t power = uint8_t(bits >> 23);
  uint32_t fraction = bits & 0x7FFFFF;
  if (power) fraction |= 0x800000;
  Scaled s = {uint64_t(fraction), int16_t((power ? power : 1) - 150), 0};
  while (!(s.mantissa >> 59)) {
    s.mantissa <<= 1;
    --s.binary;
  }
  while (isTooLarge(s)) s = overTen(s);
  while (isTooSmall(s)) s = timesTen(s);
  const uint32_t number = quartersOf(s);
  // Below a power of two the steps are half as large.
  const uint32_t steps = fraction == 0x800000 ? 4 : 2;
  return {number, number / fraction / steps, int16_t(kMostDigits - 1 - s.decimal)};
}

uint32_t tensOf(uint8_t digits) {
  uint32_t ten = 1;
  for (uint8_t i = 0; i < digits; ++i) ten *= 10;
  return ten;
}

/// Nine digits that end in as many zeros as possible and still read back as the same float.
uint32_t shortened(const Digits& digits) {
  for (uint8_t kept = kFewestDigits; kept < kMostDigits; ++kept) {
    const uint32_t unit = 4 * tensOf(uint8_t(kMostDigits - kept));
    const uint32_t rounded = (digits.quarters + unit / 2) / unit * unit;
    const uint32_t change =
        rounded > digits.quarters ? rounded - digits.quarters : digits.quarters - rounded;
    // Two more, because quarters and room are rounded too.
    if (change + 2 <= digits.room || change == 0) return rounded / 4;
  }
  return (digits.quarters + 2) / 4;
}

/// Writes text from front to back.
struct Writer {
  char* next;
  void put(char c) { *next++ = c; }
  void put(const char* text) {
    while (*text) put(*text++);
  }
};

/// The digits with the point after the first `before` of them; no zeros at the end.
void putDigits(Writer& out, uint32_t number, int8_t before) {
  if (before <= 0) out.put("0.");
  for (int8_t i = before; i < 0; ++i) out.put('0');
  uint32_t unit = kNineDigits;
  for (int8_t place = 0; number != 0 || place < before; ++place, unit /= 10) {
    if (place == before && before > 0) out.put('.');
    out.put(char('0' + number / unit));
    number %= unit;
  }
}

void putExponent(Writer& out, int16_t exponent) {
  out.put('e');
  if (exponent < 0) out.put('-');
  const uint8_t size = uint8_t(exponent < 0 ? -exponent : exponent);
  if (size >= 10) out.put(char('0' + size / 10));
  out.put(char('0' + size % 10));
}

void putPositive(Writer& out, const Digits& digits) {
  uint32_t number = shortened(digits);
  int16_t exponent = digits.exponent;
  if (number >= 10 * kNineDigits) {
    number /= 10;
    ++exponent;
  }
  const bool plain = exponent >= -4 && exponent < kMostDigits;
  putDigits(out, number, plain ? int8_t(exponent + 1) : int8_t(1));
  if (!plain) putExponent(out, exponent);
}

}  // namespace

ValueText formatValue(float value) {
  uint32_t bits = bitsOf(value);
  ValueText result;
  Writer out = {result.text};
  const bool negative = bits >> 31;
  bits &= 0x7FFFFFFF;
  if (negative && bits) out.put('-');
  if (bits)
    putPositive(out, digitsOf(bits));
  else
    out.put('0');
  out.put('\0');
  return result;
}

}  // namespace settings
