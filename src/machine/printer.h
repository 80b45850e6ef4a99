// Text and numbers to the computer; lines end as the clients need it.
#pragma once

#include "flash_text.h"
#include "ports.h"

namespace machine {

/// Writes to the wire. Nothing is buffered here, so begin a line only when all of it is known.
class Printer {
 public:
  explicit Printer(Wire& wire) : wire_(wire) {}

  Printer& operator<<(FlashText text);
  Printer& operator<<(const char* text);
  Printer& operator<<(char character);
  Printer& operator<<(int32_t number);

  /// A number with up to 4 `decimals`, rounded, never with an exponent. A NaN, or a number too
  /// large for any machine, shows as zero: clients stop at words such as "nan".
  Printer& fixed(float number, uint8_t decimals);

  /// Ends the line.
  void end();

  /// A whole line of fixed text.
  void line(FlashText text);

 private:
  Wire& wire_;
};

/// Writes the digits of a number that cannot be negative, with a zero at the end. Returns their
/// beginning in `room`.
const char* digitsOf(uint32_t number, char (&room)[12]);

}  // namespace machine
