// Runs the firmware on a simulated Mega and asks it questions over its serial port:
// `ask_firmware ELF TOLERANCE QUESTION ANSWER [QUESTION ANSWER]...`. A number in an answer may be
// off by the tolerance, everything else must be the same. 0: all answers came as expected, 1: one
// did not, 2: it could not be tried.
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>

namespace {

const uint32_t kClock = 16000000;
const avr_cycle_count_t kPatience = kClock;  // one second of the board for each answer

/// The wire to the board: what is still to be sent, and what came back.
struct Wire {
  avr_irq_t* input = nullptr;
  std::string to_send, line, answer;
  bool answered = false;
};

void onCharacter(avr_irq_t*, uint32_t value, void* parameter) {
  Wire& wire = *static_cast<Wire*>(parameter);
  const char c = char(value);
  if (c == '\n') {
    wire.answer = wire.line;
    wire.answered = true;
    wire.line.clear();
  } else if (c != '\r') {
    wire.line += c;
  }
}

/// The board has room: one character, as one more may be asked for while this one is taken.
void onRoom(avr_irq_t*, uint32_t, void* parameter) {
  Wire& wire = *static_cast<Wire*>(parameter);
  if (wire.to_send.empty()) return;
  const char c = wire.to_send.front();
  wire.to_send.erase(0, 1);
  avr_raise_irq(wire.input, uint8_t(c));
}

void connect(avr_t* avr, Wire& wire) {
  uint32_t flags = 0;
  avr_ioctl(avr, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
  flags &= ~uint32_t(AVR_UART_FLAG_STDIO);
  avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  const uint32_t port = AVR_IOCTL_UART_GETIRQ('0');
  wire.input = avr_io_getirq(avr, port, UART_IRQ_INPUT);
  avr_irq_register_notify(avr_io_getirq(avr, port, UART_IRQ_OUTPUT), onCharacter, &wire);
  avr_irq_register_notify(avr_io_getirq(avr, port, UART_IRQ_OUT_XON), onRoom, &wire);
}

/// Lets the board run until it has sent a line; false if it does not in time.
bool awaitAnswer(avr_t* avr, Wire& wire) {
  const avr_cycle_count_t end = avr->cycle + kPatience;
  wire.answered = false;
  while (!wire.answered && avr->cycle < end) {
    const int state = avr_run(avr);
    if (state == cpu_Done || state == cpu_Crashed) return false;
  }
  return wire.answered;
}

bool isNumber(const std::string& word, double& value) {
  char* end;
  value = std::strtod(word.c_str(), &end);
  return end != word.c_str() && *end == '\0' && std::isfinite(value);
}

/// Word by word: numbers within the tolerance, everything else the same.
bool agree(const std::string& got, const std::string& expected, double tolerance) {
  std::istringstream got_words(got), expected_words(expected);
  std::string one, other;
  while (expected_words >> other) {
    double value, wanted;
    if (!(got_words >> one)) return false;
    if (isNumber(one, value) && isNumber(other, wanted)) {
      if (!(std::fabs(value - wanted) <= tolerance)) return false;
    } else if (one != other) {
      return false;
    }
  }
  return !(got_words >> one);
}

int ask(avr_t* avr, Wire& wire, double tolerance, char** pairs) {
  // Open straps: a board without a shield, which reads like v1.2.
  for (const char* greeting : {"PCB v1.2 Detected", "Plumb, firmware for the Maslow CNC"}) {
    if (awaitAnswer(avr, wire) && wire.answer == greeting) continue;
    std::fprintf(stderr, "ask_firmware: the board does not greet with %s\n", greeting);
    return 1;
  }
  for (; pairs[0] != nullptr; pairs += 2) {
    wire.to_send += std::string(pairs[0]) + "\n";
    const bool came = awaitAnswer(avr, wire);
    std::printf("%s -> %s\n", pairs[0], came ? wire.answer.c_str() : "(nothing)");
    if (came && agree(wire.answer, pairs[1], tolerance)) continue;
    std::fprintf(stderr, "ask_firmware: expected %s within %g\n", pairs[1], tolerance);
    return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5 || argc % 2 == 0) {
    std::fprintf(stderr, "ask_firmware: give ELF TOLERANCE QUESTION ANSWER ...\n");
    return 2;
  }
  elf_firmware_t firmware;
  std::memset(&firmware, 0, sizeof firmware);
  if (elf_read_firmware(argv[1], &firmware) != 0) {
    std::fprintf(stderr, "ask_firmware: cannot read %s; build it with pio run\n", argv[1]);
    return 2;
  }
  avr_t* avr = avr_make_mcu_by_name("atmega2560");
  avr_init(avr);
  avr->frequency = kClock;
  avr_load_firmware(avr, &firmware);
  Wire wire;
  connect(avr, wire);
  return ask(avr, wire, std::atof(argv[2]), argv + 3);
}
