// Writes digits itself: the library's printf would cost 2 KB, and does not read text in flash.
#include "printer.h"

#include <math.h>

namespace machine {

const char* digitsOf(uint32_t number, char (&room)[12]) {
  char* at = room + sizeof room - 1;
  *at = '\0';
  do {
    *--at = char('0' + number % 10);
    number /= 10;
  } while (number != 0);
  return at;
}

Printer& Printer::operator<<(FlashText text) {
  for (const char* at = text.at;; ++at) {
    const char character = char(pgm_read_byte(at));
    if (character == '\0') return *this;
    wire_.write(character);
  }
}

Printer& Printer::operator<<(const char* text) {
  for (; *text != '\0'; ++text) wire_.write(*text);
  return *this;
}

Printer& Printer::operator<<(char character) {
  wire_.write(character);
  return *this;
}

Printer& Printer::operator<<(int32_t number) {
  char room[12];
  if (number < 0) wire_.write('-');
  return *this << digitsOf(number < 0 ? 0u - uint32_t(number) : uint32_t(number), room);
}

Printer& Printer::fixed(float number, uint8_t decimals) {
  const float kLargest = 100000;  // [mm] beyond any machine; times 10^4 it still fits 32 bits
  if (!(fabs(number) < kLargest)) number = 0;
  uint32_t scale = 1;
  for (uint8_t i = 0; i < decimals; ++i) scale *= 10;
  const uint32_t scaled = uint32_t(lround(fabs(number) * float(scale)));
  if (number < 0 && scaled != 0) wire_.write('-');
  *this << int32_t(scaled / scale);
  if (decimals == 0) return *this;
  wire_.write('.');
  const uint32_t fraction = scaled % scale;
  for (uint32_t place = scale / 10; place != 0; place /= 10)
    wire_.write(char('0' + fraction / place % 10));
  return *this;
}

void Printer::end() { *this << '\r' << '\n'; }

void Printer::line(FlashText text) {
  *this << text;
  end();
}

}  // namespace machine
