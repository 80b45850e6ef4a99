// Writes digits itself: the library's printf would cost 2 KB, and does not read text in flash.
#include "printer.h"

#include <math.h>

namespace machine {

/// Four digits at a time: a division of 16 bits takes a third of the time of 32 bits.
const char* digitsOf(uint32_t number, char (&room)[12], uint8_t decimals) {
  char* at = room + sizeof room - 1;
  *at = '\0';
  for (uint8_t count = 0; number != 0 || count <= decimals;) {
    uint16_t four = uint16_t(number % 10000);
    number /= 10000;
    for (uint8_t i = 0; i < 4 && (number != 0 || four != 0 || count <= decimals); ++i, ++count) {
      if (count == decimals && decimals != 0) *--at = '.';
      *--at = char('0' + four % 10);
      four /= 10;
    }
  }
  return at;
}

Printer& Printer::operator<<(char character) {
  if (line_ == Line::kNothing) {
    const bool is_data = character == '[' || character == '<' || character == '$';
    line_ = Line::kData;
    if (!is_data && speaksGrbl()) beginMessage();
  }
  wire_.write(character);
  return *this;
}

void Printer::beginMessage() {
  putText(FLASH("[MSG:"));
  line_ = Line::kMessage;
}

/// Writes a text to the wire as it is.
void Printer::putText(FlashText text) {
  for (const char* at = text.at;; ++at) {
    const char character = char(pgm_read_byte(at));
    if (character == '\0') return;
    wire_.write(character);
  }
}

void Printer::endOnWire() {
  wire_.write('\r');
  wire_.write('\n');
  line_ = Line::kNothing;
}

Printer& Printer::operator<<(FlashText text) {
  for (const char* at = text.at;; ++at) {
    const char character = char(pgm_read_byte(at));
    if (character == '\0') return *this;
    *this << character;
  }
}

Printer& Printer::operator<<(const char* text) {
  for (; *text != '\0'; ++text) *this << *text;
  return *this;
}

Printer& Printer::operator<<(int32_t number) {
  char room[12];
  if (number < 0) *this << '-';
  return *this << digitsOf(number < 0 ? 0u - uint32_t(number) : uint32_t(number), room);
}

Printer& Printer::fixed(float number, uint8_t decimals) {
  const float kLargest = 100000;  // [mm] beyond any machine; times 10^4 it still fits 32 bits
  if (!(fabs(number) < kLargest)) number = 0;
  uint32_t scale = 1;
  for (uint8_t i = 0; i < decimals; ++i) scale *= 10;
  const uint32_t scaled = uint32_t(lround(fabs(number) * float(scale)));
  if (number < 0 && scaled != 0) *this << '-';
  char room[12];
  return *this << digitsOf(scaled, room, decimals);
}

void Printer::end() {
  if (line_ == Line::kNothing && speaksGrbl()) return;
  if (line_ == Line::kMessage) wire_.write(']');
  endOnWire();
  if (number_ == 0) return;
  const uint8_t number = number_;
  number_ = 0;
  sayVerdict(verdict_, number);
}

void Printer::line(FlashText text) {
  *this << text;
  end();
}

void Printer::plain(FlashText text) {
  putText(text);
  endOnWire();
}

Printer& Printer::begin(FlashText words, FlashText verdict, uint8_t number) {
  if (!speaksGrbl()) return *this << words;
  beginMessage();
  verdict_ = verdict;
  number_ = number;
  return *this;
}

void Printer::sayVerdict(FlashText verdict, uint8_t number) {
  putText(verdict);
  line_ = Line::kData;
  *this << int32_t(number);
  endOnWire();
}

}  // namespace machine
