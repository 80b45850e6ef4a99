// A program for the simulated Mega: sum, difference, product and quotient of src/board/float.S
// against avr-libc's, bit by bit, and their cycles. Sends lines "name number". Not part of the
// firmware.
#include <avr/io.h>
#include <stdint.h>
#include <string.h>

extern "C" {
// Functions of the firmware.
float __mulsf3(float, float);
float __addsf3(float, float);
float __subsf3(float, float);
float __divsf3(float, float);
// Functions of avr-libc, by its inner steps; see float_of_libc.S.
float productOfLibc(float, float);
float sumOfLibc(float, float);
float quotientOfLibc(float, float);
}

namespace {

typedef uint32_t Bits;
const Bits kSign = 0x80000000UL;

// Zero, the smallest and the largest number, 1 and its neighbours, infinity, NaN.
const Bits kEdges[] = {
    0,          kSign,      1,          2,          0x7fffff,   0x800000,   0x800001,   0x80ffffff,
    0x3f800000, 0x3f800001, 0x3f7fffff, 0xbf800000, 0xbf7fffff, 0x7f7fffff, 0x7f000000, 0xff7fffff,
    0x7f800000, 0xff800000, 0x7fc00000, 0x7f800001, 0xffc00001, 0x4b800000, 0x4b7fffff, 0xcb800001,
    0x1fffffff, 0x20000000, 0x5f800000, 0x00400000, 0x3f000000, 0x3effffff, 0x3fc00001};
const uint8_t kEdgeCount = sizeof kEdges / sizeof kEdges[0];

float floatOf(Bits bits) {
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

Bits bitsOf(float value) {
  Bits bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

uint16_t products, sums, differences, quotients;  // results that differ from avr-libc's

void checkQuotient(Bits a, Bits b) {
  const float x = floatOf(a), y = floatOf(b);
  if (bitsOf(__divsf3(x, y)) != bitsOf(quotientOfLibc(x, y))) ++quotients;
}

void checkProduct(Bits a, Bits b) {
  const float x = floatOf(a), y = floatOf(b);
  if (bitsOf(__mulsf3(x, y)) != bitsOf(productOfLibc(x, y))) ++products;
}

void check(Bits a, Bits b) {
  const float x = floatOf(a), y = floatOf(b), minus_y = floatOf(b ^ kSign);
  checkProduct(a, b);
  if (bitsOf(__addsf3(x, y)) != bitsOf(sumOfLibc(x, y))) ++sums;
  if (bitsOf(__subsf3(x, y)) != bitsOf(sumOfLibc(x, minus_y))) ++differences;
  checkQuotient(a, b);
}

Bits random() {
  static Bits state = 20251;
  state = state * 1664525 + 1013904223;
  return state ^ state >> 16;
}

/// A random pair, a pair whose exponents are near, and pairs that nearly cancel or have few digits.
void checkRandomPairs() {
  const Bits a = random(), b = random();
  check(a, b);
  const uint8_t apart = uint8_t((b >> 23) % 52), exponent = uint8_t(a >> 23);
  const Bits near = (b & 0x807fffff) | Bits(uint8_t(exponent + apart - 26)) << 23;
  check(a, near);
  check(a & 0xffff0000, near & 0xffff0000);
  // 13 binary digits by 12: the product has 25, and the last is half a unit of what is kept.
  checkProduct(a & 0xfffff800, near & 0xfffff000);
  check(a, (a ^ kSign) + (b & 7));
}

/// Random pairs, most with a plain quotient; in every second pair a number has few digits.
void checkRandomQuotients() {
  const Bits a = random(), b = random();
  checkQuotient(a, b);
  checkQuotient(b & 0xbfffffff, a & 0xbfffffff);
  checkQuotient(a & 0xffffff00, b);
  checkQuotient(a, b & 0xffffe000);
}

void send(char character) {
  while (!(UCSR0A & 1 << UDRE0)) {
  }
  UDR0 = uint8_t(character);
}

void tell(const char* name, uint16_t number) {
  while (*name != '\0') send(*name++);
  send(' ');
  for (uint16_t unit = 10000; unit != 0; unit /= 10) send(char('0' + number / unit % 10));
  send('\n');
}

uint16_t cyclesOf(float (*work)(float, float)) {
  const uint16_t kRounds = 64;
  volatile float x = 1234.567f, y = 3.1415f, z;
  TCCR1A = 0;
  TCCR1B = 1 << CS10;
  TCNT1 = 0;
  for (uint8_t i = 0; i < kRounds; ++i) z = work(x, y);
  (void)z;
  return TCNT1 / kRounds;
}

}  // namespace

int main() {
  UCSR0B = 1 << TXEN0;
  for (uint8_t i = 0; i < kEdgeCount; ++i)
    for (uint8_t k = 0; k < kEdgeCount; ++k) check(kEdges[i], kEdges[k]);
  for (uint16_t i = 0; i < 5000; ++i) checkRandomPairs();
  for (uint16_t i = 0; i < 6000; ++i) checkRandomQuotients();
  tell("products", products);
  tell("sums", sums);
  tell("differences", differences);
  tell("quotients", quotients);
  tell("product_cycles", cyclesOf(__mulsf3));
  tell("product_cycles_of_libc", cyclesOf(productOfLibc));
  tell("sum_cycles", cyclesOf(__addsf3));
  tell("sum_cycles_of_libc", cyclesOf(sumOfLibc));
  tell("quotient_cycles", cyclesOf(__divsf3));
  tell("quotient_cycles_of_libc", cyclesOf(quotientOfLibc));
  for (;;) {
  }
}
