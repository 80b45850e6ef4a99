// The firmware as it is flashed, on a simulated Mega: its serial line, pins, memory and time.
#pragma once

#include <simavr/avr_eeprom.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_timer.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace vm {

const uint32_t kClock = 16000000;      // [Hz]
const uint32_t kBootloader = 0x3e000;  // by an Arduino's fuses
const uint16_t kRamBegin = 0x200, kRamEnd = 0x2200;

/// A Mega 2560 with a program in its flash.
class VirtualBoard {
 public:
  /// Loads an ELF file; throws std::runtime_error if it cannot be read. `bootloader`: the bytes of
  /// what starts first, from kBootloader on.
  explicit VirtualBoard(const std::string& elf, const std::string& bootloader = "");
  ~VirtualBoard() { avr_terminate(avr_); }
  VirtualBoard(const VirtualBoard&) = delete;
  VirtualBoard& operator=(const VirtualBoard&) = delete;

  /// Runs for `cycles`, or throws if the processor crashes.
  void run(avr_cycle_count_t cycles);
  void runMs(double ms) { run(avr_cycle_count_t(ms * kClock / 1000)); }

  /// Sends characters to the board, as fast as it takes them.
  void send(const std::string& characters);
  /// Whether a status report has just begun, so that the main program is busy with it.
  bool reports() const { return partial_ == "<"; }

  /// Lines that the board sent since the last call, without their ends; and all characters.
  std::deque<std::string> lines;
  std::string said;

  /// Pulls an input of the Mega (Arduino's number) high or low.
  void setPin(int pin, bool high);
  /// The level of a pin: 0, 255, or the duty of its PWM.
  uint8_t pin(int pin) const;
  /// Calls `note` with the level of an output at each of its edges.
  void watchPin(int pin, std::function<void(bool)> note);

  /// Sets the Mega's supply [V], as its converter measures it.
  void setSupply(double volts);

  /// Straps the six pins from 22 on; a bit for each open pin.
  void strap(uint8_t open);

  /// How often the processor was reset since its power came; a reset opens all pins.
  int resets() const { return resets_; }

  // Faults.
  /// Makes the program loop for ever from here on: in the control tick, or in the main program.
  void hang(bool in_tick);
  /// Lets the main program go on where it hung, `cycles` after a tick.
  void wake(double ms_after_tick);
  /// Keeps interrupts off until allowInterrupts().
  void holdInterrupts();
  void allowInterrupts();
  /// Stops timer 1.
  void stopTickTimer();

  /// The program, as a bootloader may have written it.
  std::vector<uint8_t> flash();
  void setFlash(const std::vector<uint8_t>& bytes);
  std::vector<uint8_t> eeprom() const;
  void setEeprom(const std::vector<uint8_t>& bytes);

  /// From now on follows the stack at each instruction, which is slower.
  void followStack() { is_stack_followed_ = true; }
  /// [bytes] Deepest stack of the main program by itself, and of interrupts, since followStack().
  /// An interrupt may come where the main program is deepest: what the stack needs is their sum.
  int mainStack() const { return main_stack_; }
  int interruptStack() const { return interrupt_stack_; }
  /// Writes into the last bytes above the program's data, as a stack without end would.
  void overrunStack();

  /// Share of the time, and most cycles, that the control tick takes. While it runs, its interrupt
  /// is switched off. Other interrupts in between are included.
  double tickShare() const { return double(in_tick_) / double(avr_->cycle - watched_from_); }
  void watchTicksFromNow() {
    in_tick_ = longest_tick_ = longest_gap_ = asleep_ = 0;
    ticks_ = 0;
    watched_from_ = avr_->cycle;
  }
  long longestTick() const { return long(longest_tick_); }
  /// Most cycles from the beginning of a tick to the beginning of the next, and since the last
  /// tick.
  long longestGap() const {
    const avr_cycle_count_t since = std::max(tick_since_, watched_from_);
    return long(std::max(longest_gap_, avr_->cycle - since));
  }
  double ticksPerSecond() const {
    return ticks_ * double(kClock) / double(avr_->cycle - watched_from_);
  }

  /// Share of that time in which the processor was asleep.
  double sleepShare() const { return double(asleep_) / double(avr_->cycle - watched_from_); }

  double seconds() const { return double(avr_->cycle) / kClock; }
  avr_t* avr() { return avr_; }

 private:
  /// Levels from outside that hold pins of a port, whatever the program writes.
  void pull(char port, uint8_t mask, uint8_t levels);
  /// To be called after a reset, in which simavr also clears the inputs and its timers.
  void restoreOutside();
  static void onEdge(avr_irq_t*, uint32_t value, void* note);
  /// Time passes without waiting for real time.
  static void onSleep(avr_t*, avr_cycle_count_t cycles);
  static void onCharacter(avr_irq_t*, uint32_t value, void* board);
  /// simavr takes some ADIW and SBIW for a call of two words, so a skip over such a word would skip
  /// the next one too. Each such skip is replaced by an OUT that ends a burst; runWideSkip() then
  /// runs the skip itself, with a NOP behind it.
  void markWideSkips();
  void unmarkWideSkips();
  static void onWideSkip(avr_t*, avr_io_addr_t, uint8_t, void* board);
  int runWideSkip();
  uint16_t word(uint32_t at) const { return uint16_t(avr_->flash[at] | avr_->flash[at + 1] << 8); }
  void setWord(uint32_t at, uint16_t code) {
    avr_->flash[at] = uint8_t(code);
    avr_->flash[at + 1] = uint8_t(code >> 8);
  }
  void awaitNextCharacter();
  /// Cycles of a character at the speed to which the program set the line.
  avr_cycle_count_t characterCycles() const;
  void loadBootloader(const std::string& bytes);
  static avr_cycle_count_t onNextCharacter(avr_t*, avr_cycle_count_t, void* board);
  static avr_cycle_count_t onEndOfRun(avr_t*, avr_cycle_count_t, void*);
  static void onTimerMask(avr_t*, avr_io_addr_t address, uint8_t mask, void* board);
  /// Runs for at most `cycles` and an instruction, up to the next interrupt or timer.
  void step(avr_cycle_count_t most_cycles);
  void runUntil(bool in_tick);
  /// simavr never resets while the watchdog's interrupt waits.
  void watchWatchdog();
  void noteTick();
  void noteStack();
  void noteTickMask(bool is_allowed);

  avr_t* avr_;
  avr_uart_t* line_;
  avr_irq_t* wire_in_;
  std::deque<std::function<void(bool)>> watches_;  ///< of pins; their addresses must not change
  std::map<char, avr_ioport_external_t> outside_;
  std::string to_send_, partial_;
  avr_cycle_count_t next_character_ = 0;
  uint16_t data_end_;
  uint32_t program_end_;
  bool are_skips_marked_ = false;
  avr_flashaddr_t hung_at_ = 0;
  avr_cycle_count_t beyond_ = 0;  ///< by which the last run was too long
  avr_cycle_count_t in_tick_ = 0, longest_tick_ = 0, tick_since_ = 0, watched_from_ = 0;
  avr_cycle_count_t longest_gap_ = 0, asleep_ = 0;
  avr_cycle_count_t bitten_since_ = 0;
  int ticks_ = 0, resets_ = 0;
  int main_stack_ = 0, interrupt_stack_ = 0;
  uint16_t main_pointer_ = 0;  ///< the stack's pointer when the main program ran last
  std::map<avr_flashaddr_t, uint16_t> wide_skips_;  ///< what stood where an OUT is now
  bool is_at_wide_skip_ = false;
  bool is_stack_followed_ = false;
  bool are_interrupts_held_ = false;
  bool was_ticking_ = false, is_tick_masked_ = false;
};

}  // namespace vm
