// The simulated Mega, by simavr.
#include "virtual_board.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <fstream>

namespace vm {
namespace {

// Everything that is read between two runs of the simulator is at most this old.
const avr_cycle_count_t kMostAtOnce = 500;
const uint16_t kOutlivesReset = 16;  // [bytes] most above .bss, for variables that no start clears

/// A pin of the Mega: port letter, bit, and the registers of its PWM.
struct PinPlace {
  int pin;
  char port;
  int bit;
  uint16_t compare, control;  // data addresses; 0: no PWM
  int control_bit;            // COMnx1
};

const PinPlace kPins[] = {
    {2, 'E', 4, 0x9a, 0x90, 5}, {3, 'E', 5, 0x9c, 0x90, 3}, {4, 'G', 5, 0, 0, 0},
    {5, 'E', 3, 0x98, 0x90, 7}, {6, 'H', 3, 0xa8, 0xa0, 7}, {7, 'H', 4, 0xaa, 0xa0, 5},
    {8, 'H', 5, 0xac, 0xa0, 3}, {9, 'H', 6, 0xb4, 0xb0, 5}, {10, 'B', 4, 0xb3, 0xb0, 7},
    {11, 'B', 5, 0, 0, 0},      {12, 'B', 6, 0, 0, 0},      {13, 'B', 7, 0, 0, 0},
    {14, 'J', 1, 0, 0, 0},      {16, 'H', 1, 0, 0, 0},      {17, 'H', 0, 0, 0, 0},
    {18, 'D', 3, 0, 0, 0},      {19, 'D', 2, 0, 0, 0},      {20, 'D', 1, 0, 0, 0},
    {21, 'D', 0, 0, 0, 0},      {22, 'A', 0, 0, 0, 0},      {23, 'A', 1, 0, 0, 0},
    {24, 'A', 2, 0, 0, 0},      {25, 'A', 3, 0, 0, 0},      {26, 'A', 4, 0, 0, 0},
    {27, 'A', 5, 0, 0, 0},      {40, 'G', 1, 0, 0, 0},      {41, 'G', 0, 0, 0, 0},
    {43, 'L', 6, 0, 0, 0},
};

const PinPlace& placeOf(int pin) {
  for (const PinPlace& place : kPins)
    if (place.pin == pin) return place;
  throw std::runtime_error("no such pin: " + std::to_string(pin));
}

const uint16_t kWdtcsr = 0x60, kMcusr = 0x54;
const uint16_t kUbrr0l = 0xc4, kUbrr0h = 0xc5, kUcsr0a = 0xc0;
const uint16_t kFirstTimerMask = 0x6e, kLastTimerMask = 0x73;  // TIMSK0 to TIMSK5
const uint16_t kTickMask = 0x6f;                               // TIMSK1
const uint8_t kTickBit = 2;                                    // OCIE1A
const avr_flashaddr_t kTickVector = 17 * 4;

/// A flag that is set while its interrupt is masked must interrupt once the mask allows it; simavr
/// drops such a flag.
void raiseWaiting(avr_t* avr, avr_io_addr_t mask_address) {
  for (int i = 0; i < avr->interrupts.vector_count; ++i) {
    avr_int_vector_t* const vector = avr->interrupts.vector[i];
    const bool waits = vector->enable.reg == mask_address && vector->raised.reg != 0 &&
                       avr_regbit_get(avr, vector->enable) && avr_regbit_get(avr, vector->raised);
    if (waits && !vector->pending) avr_raise_interrupt(avr, vector);
  }
}

/// simavr does not know phase-correct PWM and lets such a timer overflow with every count, 100,000
/// times a second. Only the duty of such a timer is needed here.
void slowDownPhaseCorrectTimers(avr_t* avr) {
  const int kPhaseCorrect8Bit = 1;
  for (avr_io_t* part = avr->io_port; part != nullptr; part = part->next) {
    if (std::strcmp(part->kind, "timer") != 0) continue;
    avr_timer_wgm_t& mode = reinterpret_cast<avr_timer_t*>(part)->wgm_op[kPhaseCorrect8Bit];
    if (mode.kind != avr_timer_wgm_none) continue;
    mode.kind = avr_timer_wgm_normal;
    mode.size = 16;
  }
}

/// The part of simavr that is the first serial line.
avr_uart_t* serialLineOf(avr_t* avr) {
  for (avr_io_t* part = avr->io_port; part != nullptr; part = part->next) {
    avr_uart_t* const line = reinterpret_cast<avr_uart_t*>(part);
    if (std::strcmp(part->kind, "uart") == 0 && line->name == '0') return line;
  }
  throw std::runtime_error("simavr has no serial line");
}

/// Whether an instruction may skip the next: SBRC, SBRS, CPSE, SBIC or SBIS.
bool isSkip(uint16_t code) {
  const uint16_t top = code & 0xff00;
  return (code & 0xfc08) == 0xfc00 || (code & 0xfc00) == 0x1000 || top == 0x9900 || top == 0x9b00;
}

// A register that the Mega does not have, and OUT to it.
const uint16_t kNoRegister = 0x59, kOutToIt = 0xbe09;

/// simavr prints what it loads and what it lacks on standard output.
void logNothing(avr_t*, const int, const char*, va_list) {}

}  // namespace

VirtualBoard::VirtualBoard(const std::string& elf, const std::string& bootloader) {
  avr_global_logger_set(logNothing);
  if (!std::ifstream(elf))
    throw std::runtime_error("cannot read " + elf + "; build it with pio run");
  elf_firmware_t firmware;
  std::memset(&firmware, 0, sizeof firmware);
  if (elf_read_firmware(elf.c_str(), &firmware) != 0)
    throw std::runtime_error("cannot read " + elf + "; build it with pio run");
  data_end_ = uint16_t(kRamBegin + firmware.datasize + firmware.bsssize);
  avr_ = avr_make_mcu_by_name("atmega2560");
  avr_init(avr_);
  slowDownPhaseCorrectTimers(avr_);
  avr_->frequency = kClock;
  setSupply(5);
  avr_load_firmware(avr_, &firmware);
  program_end_ = firmware.flashsize;
  if (bootloader.empty())
    markWideSkips();
  else
    loadBootloader(bootloader);
  avr_register_io_write(avr_, kNoRegister, onWideSkip, this);
  for (uint16_t mask = kFirstTimerMask; mask <= kLastTimerMask; ++mask)
    avr_register_io_write(avr_, mask, onTimerMask, this);
  avr_->custom.data = this;
  avr_->sleep = onSleep;
  uint32_t flags = 0;
  avr_ioctl(avr_, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
  flags &= ~uint32_t(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POLL_SLEEP);
  avr_ioctl(avr_, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  const uint32_t port = AVR_IOCTL_UART_GETIRQ('0');
  line_ = serialLineOf(avr_);
  wire_in_ = avr_io_getirq(avr_, port, UART_IRQ_INPUT);
  avr_irq_register_notify(avr_io_getirq(avr_, port, UART_IRQ_OUTPUT), onCharacter, this);
}

void VirtualBoard::loadBootloader(const std::string& bytes) {
  std::memcpy(avr_->flash + kBootloader, bytes.data(), bytes.size());
  avr_->reset_pc = avr_->pc = program_end_ = kBootloader;
  avr_->codeend = avr_->flashend;
}

std::vector<uint8_t> VirtualBoard::flash() {
  unmarkWideSkips();
  return {avr_->flash, avr_->flash + program_end_};
}

void VirtualBoard::setFlash(const std::vector<uint8_t>& bytes) {
  std::copy(bytes.begin(), bytes.end(), avr_->flash);
}

void VirtualBoard::markWideSkips() {
  are_skips_marked_ = true;
  const uint16_t kJump = 0x940c;
  // Before the code that a reset jumps to there are vectors and tables.
  for (uint32_t at = word(0) == kJump ? 2u * word(2) : 0; at + 4 <= program_end_; at += 2) {
    const uint16_t next = word(at + 2);
    const bool adds = (next & 0xfe00) == 0x9600, taken_for_call = (next & 0x000c) == 0x000c;
    if (!isSkip(word(at)) || !adds || !taken_for_call) continue;
    wide_skips_[at] = word(at);
    setWord(at, kOutToIt);
  }
}

void VirtualBoard::unmarkWideSkips() {
  are_skips_marked_ = false;
  for (const auto& marked : wide_skips_)
    if (word(marked.first) == kOutToIt) setWord(marked.first, marked.second);
  wide_skips_.clear();
}

void VirtualBoard::onWideSkip(avr_t* avr, avr_io_addr_t, uint8_t, void* parameter) {
  // OUT takes no time, ends the burst, and no interrupt comes behind it.
  avr->cycle -= 1;
  avr->run_cycle_count = 0;
  avr->interrupt_state = -2;
  static_cast<VirtualBoard*>(parameter)->is_at_wide_skip_ = true;
}

int VirtualBoard::runWideSkip() {
  is_at_wide_skip_ = false;
  const auto marked = wide_skips_.find(avr_->pc - 2);
  if (marked == wide_skips_.end()) return avr_->state;  // a reset came
  const avr_flashaddr_t at = marked->first;
  const uint16_t behind = word(at + 2), kNothing = 0;
  setWord(at, marked->second);
  setWord(at + 2, kNothing);
  avr_->pc = at;
  avr_->run_cycle_limit = avr_->run_cycle_count = 1;
  const int state = avr_run(avr_);
  setWord(at, kOutToIt);
  setWord(at + 2, behind);
  return state;
}

void VirtualBoard::onCharacter(avr_irq_t*, uint32_t value, void* parameter) {
  VirtualBoard& board = *static_cast<VirtualBoard*>(parameter);
  const char character = char(value);
  board.said += character;
  if (character == '\n') {
    board.lines.push_back(board.partial_);
    board.partial_.clear();
  } else if (character != '\r') {
    board.partial_ += character;
  }
}

void VirtualBoard::onSleep(avr_t* avr, avr_cycle_count_t cycles) {
  static_cast<VirtualBoard*>(avr->custom.data)->asleep_ += cycles;
}

void VirtualBoard::send(const std::string& characters) {
  if (characters.empty()) return;
  // simavr counts eleven bits, so a line without a gap would overrun.
  line_->cycles_per_byte = characterCycles();
  const bool is_under_way = !to_send_.empty();
  to_send_ += characters;
  if (!is_under_way) awaitNextCharacter();
}

avr_cycle_count_t VirtualBoard::characterCycles() const {
  const int divider = avr_->data[kUbrr0l] | avr_->data[kUbrr0h] << 8;
  const bool is_doubled = avr_->data[kUcsr0a] & 2;
  const int kUsual = 16;  // 58,824 baud
  return avr_cycle_count_t(10 * (is_doubled ? 8 : 16) * ((divider > 0 ? divider : kUsual) + 1));
}

void VirtualBoard::awaitNextCharacter() {
  const avr_cycle_count_t now = avr_->cycle;
  avr_cycle_timer_register(avr_, std::max(next_character_, now + 1) - now, onNextCharacter, this);
}

avr_cycle_count_t VirtualBoard::onNextCharacter(avr_t* avr, avr_cycle_count_t, void* parameter) {
  VirtualBoard& board = *static_cast<VirtualBoard*>(parameter);
  const uint8_t character = uint8_t(board.to_send_.front());
  board.to_send_.erase(0, 1);
  board.next_character_ = avr->cycle + board.characterCycles();
  avr_raise_irq(board.wire_in_, character);
  return board.to_send_.empty() ? 0 : board.next_character_;
}

// It comes again, so that a processor that falls asleep in the last instructions does not wake a
// millisecond later.
avr_cycle_count_t VirtualBoard::onEndOfRun(avr_t*, avr_cycle_count_t when, void*) {
  return when + 1;
}

void VirtualBoard::run(avr_cycle_count_t cycles) {
  // What the last instruction took too long is taken off the next run. Else the board would gain on
  // the world, and every few seconds all axes would seem to stand still for a millisecond.
  const avr_cycle_count_t left = cycles - beyond_, end = avr_->cycle + left;
  // No burst of instructions and no sleep goes past a timer.
  avr_cycle_timer_register(avr_, left, onEndOfRun, this);
  while (avr_->cycle < end) step(is_stack_followed_ ? 1 : kMostAtOnce);
  avr_cycle_timer_cancel(avr_, onEndOfRun, this);
  beyond_ = avr_->cycle - end;
}

void VirtualBoard::step(avr_cycle_count_t most_cycles) {
  if (avr_->run_cycle_limit != most_cycles) avr_->run_cycle_limit = avr_->run_cycle_count = 1;
  // Below zero simavr waits. The program's interrupt flag stays: the program saves and restores it.
  if (are_interrupts_held_) avr_->interrupt_state = -10;
  int state = avr_run(avr_);
  if (is_at_wide_skip_) state = runWideSkip();
  avr_->run_cycle_limit = most_cycles;
  noteTick();
  if (is_stack_followed_) noteStack();
  watchWatchdog();
  if (avr_->pc == avr_->reset_pc) restoreOutside();
  // When the bootloader reads the flash back, there are no marks in it.
  if (!are_skips_marked_ && avr_->pc < program_end_) markWideSkips();
  if (state == cpu_Done || state == cpu_Crashed) throw std::runtime_error("the board crashed");
}

void VirtualBoard::watchWatchdog() {
  if (!(avr_->data[kWdtcsr] & 0x80)) {
    bitten_since_ = 0;
    return;
  }
  // Interrupts are off, so the flag waits; the second time-out resets.
  if (bitten_since_ == 0) bitten_since_ = avr_->cycle;
  const int prescaler = avr_->data[kWdtcsr] & 7;
  if (avr_->cycle - bitten_since_ < (2048ull << prescaler) * kClock / 128000) return;
  avr_reset(avr_);
  avr_->data[kMcusr] = avr_->data[kWdtcsr] = 1 << 3;  // WDRF, WDE
}

void VirtualBoard::runUntil(bool in_tick) {
  const avr_cycle_count_t patience = avr_->cycle + kClock;
  // Only with interrupts on: not in the middle of an interrupt.
  while (was_ticking_ != in_tick || !avr_->sreg[S_I]) {
    if (avr_->cycle > patience) throw std::runtime_error("no tick came, or it did not end");
    step(1);
  }
}

void VirtualBoard::hang(bool in_tick) {
  runUntil(in_tick);
  hung_at_ = avr_->pc;
  const uint8_t kHere[] = {0xff, 0xcf};  // rjmp .
  for (avr_flashaddr_t at = 0; at < avr_->flashend; at += 2)
    if (std::memcmp(avr_->flash + at, kHere, 2) == 0) {
      avr_->pc = at;
      return;
    }
  throw std::runtime_error("no endless loop in the program");
}

void VirtualBoard::wake(double ms_after_tick) {
  runUntil(true);
  runUntil(false);
  const avr_flashaddr_t circle = avr_->pc;
  runMs(ms_after_tick);
  // Not from within an interrupt.
  while (avr_->pc != circle) step(1);
  avr_->pc = hung_at_;
}

void VirtualBoard::holdInterrupts() {
  runUntil(false);
  are_interrupts_held_ = true;
}

void VirtualBoard::allowInterrupts() {
  are_interrupts_held_ = false;
  avr_->interrupt_state = -1;
}

void VirtualBoard::stopTickTimer() {
  const avr_io_addr_t kTccr1b = 0x81;
  const auto& write = avr_->io[AVR_DATA_TO_IO(kTccr1b)].w;
  write.c(avr_, kTccr1b, avr_->data[kTccr1b] & 0xf8, write.param);
}

void VirtualBoard::noteTick() {
  if (avr_->pc != kTickVector) return;
  longest_gap_ = longestGap();
  tick_since_ = avr_->cycle;
  ++ticks_;
  was_ticking_ = true;
  is_tick_masked_ = false;
}

void VirtualBoard::noteStack() {
  const uint16_t pointer = uint16_t(avr_->data[R_SPL] | avr_->data[R_SPH] << 8);
  if (pointer < kRamBegin) return;  // not set yet
  if (avr_->interrupts.running_ptr > 0) {
    interrupt_stack_ = std::max(interrupt_stack_, main_pointer_ - pointer);
    return;
  }
  main_pointer_ = pointer;
  main_stack_ = std::max(main_stack_, kRamEnd - pointer);
}

void VirtualBoard::onTimerMask(avr_t* avr, avr_io_addr_t address, uint8_t mask, void* parameter) {
  VirtualBoard& board = *static_cast<VirtualBoard*>(parameter);
  avr->data[address] = mask;
  if (address == kTickMask) board.noteTickMask(mask & kTickBit);
  raiseWaiting(avr, address);
}

void VirtualBoard::noteTickMask(bool is_allowed) {
  if (!is_allowed) is_tick_masked_ = true;
  if (!was_ticking_ || !is_tick_masked_ || !is_allowed) return;
  was_ticking_ = false;
  const avr_cycle_count_t cycles = avr_->cycle - tick_since_;
  in_tick_ += cycles;
  longest_tick_ = std::max(longest_tick_, cycles);
}

void VirtualBoard::setPin(int pin, bool high) {
  const PinPlace& place = placeOf(pin);
  pull(place.port, uint8_t(1 << place.bit), uint8_t(high << place.bit));
  avr_raise_irq(avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ(place.port), place.bit), high);
}

void VirtualBoard::setSupply(double volts) { avr_->vcc = avr_->avcc = uint32_t(volts * 1000); }

void VirtualBoard::strap(uint8_t open) { pull('A', 0x3f, open & 0x3f); }

void VirtualBoard::pull(char port, uint8_t mask, uint8_t levels) {
  avr_ioport_external_t& outside = outside_[port];
  outside.name = port;
  outside.mask |= mask;
  outside.value = (outside.value & ~mask & 0xff) | levels;
  avr_ioctl(avr_, AVR_IOCTL_IOPORT_SET_EXTERNAL(port), &outside);
}

void VirtualBoard::restoreOutside() {
  ++resets_;
  if (avr_->reset_pc != 0) unmarkWideSkips();
  are_interrupts_held_ = false;
  if (!to_send_.empty()) awaitNextCharacter();
  for (const char port : {'A', 'B', 'C', 'D', 'E', 'F', 'G', 'H', 'J', 'K', 'L'})
    for (int bit = 0; bit < 8; ++bit) {
      avr_irq_t* const pin = avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ(port), bit);
      pin->value = 0;
      if (outside_[port].mask >> bit & 1) avr_raise_irq(pin, outside_[port].value >> bit & 1);
    }
}

uint8_t VirtualBoard::pin(int pin) const {
  const PinPlace& place = placeOf(pin);
  if (place.compare != 0 && (avr_->data[place.control] >> place.control_bit & 1))
    return avr_->data[place.compare];
  avr_ioport_state_t state;
  avr_ioctl(avr_, AVR_IOCTL_IOPORT_GETSTATE(place.port), &state);
  return state.port >> place.bit & 1 ? 255 : 0;
}

void VirtualBoard::onEdge(avr_irq_t*, uint32_t value, void* note) {
  (*static_cast<std::function<void(bool)>*>(note))(value != 0);
}

void VirtualBoard::watchPin(int pin, std::function<void(bool)> note) {
  const PinPlace& place = placeOf(pin);
  watches_.push_back(std::move(note));
  avr_irq_t* const irq = avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ(place.port), place.bit);
  avr_irq_register_notify(irq, onEdge, &watches_.back());
}

std::vector<uint8_t> VirtualBoard::eeprom() const {
  avr_eeprom_desc_t desc = {nullptr, 0, 4096};
  std::vector<uint8_t> bytes(4096);
  desc.ee = bytes.data();
  avr_ioctl(avr_, AVR_IOCTL_EEPROM_GET, &desc);
  return bytes;
}

void VirtualBoard::setEeprom(const std::vector<uint8_t>& bytes) {
  std::vector<uint8_t> copy = bytes;
  avr_eeprom_desc_t desc = {copy.data(), 0, uint32_t(copy.size())};
  avr_ioctl(avr_, AVR_IOCTL_EEPROM_SET, &desc);
}

void VirtualBoard::overrunStack() { avr_->data[data_end_ + kOutlivesReset] = 0; }

}  // namespace vm
