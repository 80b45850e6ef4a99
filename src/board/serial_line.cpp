// UART 0 by interrupts.
#include "serial_line.h"

#include <avr/interrupt.h>
#include <avr/io.h>

#include "sleep.h"

namespace board {
namespace {

// 16 without double speed is 58,824 baud. The USB chip of a genuine Mega makes the same choice.
// Double speed would be nearer to 57,600 baud, but 2.9 % away from the USB chip's rate.
const uint16_t kDivider = 16;

// A byte is the index of a ring of 256 characters, and wraps by itself. The longest report of a
// status, 110 characters, goes out without a wait.
enum : uint8_t { kMostOut = 128 };
uint8_t in_ring[256], out_ring[kMostOut];
volatile uint8_t in_head, in_tail, out_head, out_tail, lost_count;

uint8_t afterOut(uint8_t at) { return uint8_t(at + 1) % kMostOut; }

}  // namespace

ISR(USART0_RX_vect) {
  const bool overrun = UCSR0A & (1 << DOR0);
  const uint8_t character = UDR0;
  const uint8_t next = uint8_t(in_head + 1);
  if ((overrun || next == in_tail) && lost_count != 255) ++lost_count;
  if (next == in_tail) return;
  in_ring[in_head] = character;
  in_head = next;
}

ISR(USART0_UDRE_vect) {
  if (out_head == out_tail) {
    UCSR0B &= uint8_t(~(1 << UDRIE0));
    return;
  }
  UDR0 = out_ring[out_tail];
  out_tail = afterOut(out_tail);
}

void SerialLine::begin() {
  UBRR0 = kDivider;
  UCSR0A = 0;
  UCSR0C = 1 << UCSZ01 | 1 << UCSZ00;  // eight bits, no parity, one stop bit
  UCSR0B = 1 << RXEN0 | 1 << TXEN0 | 1 << RXCIE0;
}

int16_t SerialLine::read() {
  if (in_head == in_tail) return -1;
  const uint8_t character = in_ring[in_tail];
  ++in_tail;
  return character;
}

void SerialLine::write(char character) {
  const uint8_t next = afterOut(out_head);
  while (next == out_tail) sleepUntilInterrupt();
  out_ring[out_head] = uint8_t(character);
  out_head = next;
  UCSR0B |= 1 << UDRIE0;
}

uint8_t SerialLine::lost() {
  const uint8_t count = lost_count;
  if (count != 0) lost_count = 0;
  return count;
}

}  // namespace board
