// A program that checks the simulation of the Mega: each line that it sends counts interrupts. Not
// part of the firmware.
#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/delay.h>

namespace {

volatile uint8_t timer_calls, edges;

void send(char character) {
  while (!(UCSR0A & 1 << UDRE0)) {
  }
  UDR0 = uint8_t(character);
}

void tell(const char* name, uint8_t count) {
  while (*name != '\0') send(*name++);
  send(' ');
  send(char('0' + count / 10));
  send(char('0' + count % 10));
  send('\n');
}

/// Ten compare matches while their interrupt is masked.
uint8_t matchesWhileMasked() {
  TCCR1A = 0;
  OCR1A = 16000;
  for (uint8_t i = 0; i < 10; ++i) {
    TIMSK1 = 0;
    TCNT1 = 0;
    TCCR1B = 1 << WGM12 | 1 << CS10;
    _delay_us(1500);
    TCCR1B = 1 << WGM12;
    TIMSK1 = 1 << OCIE1A;
    _delay_us(10);
  }
  return timer_calls;
}

/// Ten compare matches that are cleared again while their interrupt is masked.
uint8_t matchesTakenBack() {
  timer_calls = 0;
  for (uint8_t i = 0; i < 10; ++i) {
    TIMSK1 = 0;
    TCNT1 = 0;
    TCCR1B = 1 << WGM12 | 1 << CS10;
    _delay_us(1500);
    TCCR1B = 1 << WGM12;
    TIFR1 = 1 << OCF1A;
    TIMSK1 = 1 << OCIE1A;
    _delay_us(10);
  }
  return timer_calls;
}

/// Ten writes to another pin of the port whose pins 2 and 3 are pulled low from outside.
uint8_t edgesOfOtherPins() {
  edges = 0;
  for (uint8_t i = 0; i < 10; ++i) {
    PORTE ^= 1 << 3;
    _delay_us(10);
  }
  return edges;
}

/// Sum of what is added behind ten skips, of which every second skips. simavr takes the first ADIW
/// for an instruction of two words, and would skip the next one too.
uint8_t addedBehindSkips() {
  uint16_t sum = 0;
  for (uint8_t i = 0; i < 10; ++i)
    asm volatile("sbrc %1, 0\n adiw %0, 15\n adiw %0, 1\n" : "+w"(sum) : "r"(i));
  return uint8_t(sum);
}

/// Cycles of one skip over such an ADIW, and of one that does not skip, without those around it.
uint8_t cyclesOf(uint8_t bit) {
  uint16_t sum = 0;
  uint8_t before, after;
  TCCR1A = TIMSK1 = 0;
  TCCR1B = 1 << CS10;
  asm volatile("lds %0, %3\n sbrc %4, 0\n adiw %2, 15\n lds %1, %3\n"
               : "=&r"(before), "=&r"(after), "+w"(sum)
               : "n"(_SFR_MEM_ADDR(TCNT1L)), "r"(bit));
  return uint8_t(after - before - 2);
}

}  // namespace

ISR(TIMER1_COMPA_vect) { ++timer_calls; }
ISR(INT4_vect) { ++edges; }
ISR(INT5_vect, ISR_ALIASOF(INT4_vect));

int main() {
  UBRR0 = 16;
  UCSR0B = 1 << TXEN0;
  DDRE = 1 << 3;
  PORTE = 1 << 4 | 1 << 5;
  EICRB = 0x05;
  EIMSK = 0x30;
  sei();
  tell("masked", matchesWhileMasked());
  tell("taken_back", matchesTakenBack());
  _delay_ms(5);
  tell("edges_low", edgesOfOtherPins());
  tell("added", addedBehindSkips());
  tell("skip_cycles", cyclesOf(0));
  tell("add_cycles", cyclesOf(1));
  for (;;) {
  }
}
