// The firmware as it is flashed, on a simulated Mega: its wire, its pins, its memory, its time.
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

const uint32_t kClock = 16000000;  // [Hz]
const uint16_t kRamBegin = 0x200, kRamEnd = 0x2200;

/// What a pin shows: its level, or the duty of the PWM that is switched to it.
struct PinState {
  bool pulsed;
  uint8_t level;  ///< 0, 255, or the duty
};

/// One Mega 2560 with a program in its flash.
class VirtualBoard {
 public:
  /// Loads an ELF file; throws std::runtime_error if it cannot be read.
  explicit VirtualBoard(const std::string& elf);
  ~VirtualBoard() { avr_terminate(avr_); }
  VirtualBoard(const VirtualBoard&) = delete;
  VirtualBoard& operator=(const VirtualBoard&) = delete;

  /// Runs for so many cycles, or throws if the processor crashes.
  void run(avr_cycle_count_t cycles);
  void runMs(double ms) { run(avr_cycle_count_t(ms * kClock / 1000)); }

  /// Puts characters on the wire to the board; they go as fast as it takes them.
  void send(const std::string& characters);
  /// Whether a status report has just begun, so that the main program is busy with it.
  bool reports() const { return partial_ == "<"; }
  bool hasSent() const { return to_send_.empty(); }

  /// Lines that the board sent since they were last taken, without their ends.
  std::deque<std::string> lines;

  /// Pulls an input of the Mega (Arduino's number) high or low.
  void setPin(int pin, bool high);
  PinState pin(int pin) const;
  /// Calls `note` with the level of an output at each of its edges.
  void watchPin(int pin, std::function<void(bool)> note);

  /// [V] The Mega's supply, as its converter sees it.
  void setSupply(double volts);

  /// Straps the six pins from 22 on; a bit for each that is left open.
  void strap(uint8_t open);

  /// How often the processor was reset since its power came; a reset opens all pins.
  int resets() const { return resets_; }

  // What may go wrong.
  /// The program runs in circles from here on: in the control tick, or in the main program.
  void hang(bool in_tick);
  /// The main program goes on where it hung, so long after a tick.
  void wake(double ms_after_tick);
  /// Nobody allows interrupts until allowInterrupts().
  void holdInterrupts();
  void allowInterrupts();
  /// Timer 1 stands still.
  void stopTickTimer();

  std::vector<uint8_t> eeprom() const;
  void setEeprom(const std::vector<uint8_t>& bytes);

  /// Fills unused RAM with a pattern, and tells later how many bytes of stack were ever used.
  void paintStack();
  int stackUsed() const;

  /// Share of the time, and cycles at most, that the control tick takes: it switches its own
  /// interrupt off while it runs. Other interrupts in between count.
  double tickShare() const { return double(in_tick_) / double(avr_->cycle - watched_from_); }
  void watchTicksFromNow() {
    in_tick_ = longest_tick_ = longest_gap_ = asleep_ = 0;
    ticks_ = 0;
    watched_from_ = avr_->cycle;
  }
  long longestTick() const { return long(longest_tick_); }
  /// Cycles at most from the beginning of a tick to that of the next, and from the last one on.
  long longestGap() const {
    const avr_cycle_count_t since = std::max(tick_since_, watched_from_);
    return long(std::max(longest_gap_, avr_->cycle - since));
  }
  double ticksPerSecond() const {
    return ticks_ * double(kClock) / double(avr_->cycle - watched_from_);
  }

  /// Share of that time in which the processor slept.
  double sleepShare() const { return double(asleep_) / double(avr_->cycle - watched_from_); }

  double seconds() const { return double(avr_->cycle) / kClock; }
  avr_t* avr() { return avr_; }

 private:
  /// Levels from outside that hold pins of a port, whatever is written to it.
  void pull(char port, uint8_t mask, uint8_t levels);
  /// After a reset, which simavr lets clear the inputs and its timers, too.
  void restoreOutside();
  static void onEdge(avr_irq_t*, uint32_t value, void* note);
  /// Time passes without being waited for.
  static void onSleep(avr_t*, avr_cycle_count_t cycles);
  static void onCharacter(avr_irq_t*, uint32_t value, void* board);
  void awaitNextCharacter();
  static avr_cycle_count_t onNextCharacter(avr_t*, avr_cycle_count_t, void* board);
  static avr_cycle_count_t onEndOfRun(avr_t*, avr_cycle_count_t, void*);
  static void onTimerMask(avr_t*, avr_io_addr_t address, uint8_t mask, void* board);
  /// Runs at most so many cycles and an instruction, up to the next interrupt or timer.
  void step(avr_cycle_count_t most_cycles);
  void runUntil(bool in_tick);
  /// simavr never resets while the watchdog's interrupt waits.
  void watchWatchdog();
  void noteTick();
  void noteTickMask(bool is_allowed);

  avr_t* avr_;
  avr_irq_t* wire_in_;
  std::deque<std::function<void(bool)>> watches_;  ///< of pins; they must not move
  std::map<char, avr_ioport_external_t> outside_;
  std::string to_send_, partial_;
  avr_cycle_count_t next_character_ = 0;
  uint16_t data_end_;
  avr_flashaddr_t hung_at_ = 0;
  avr_cycle_count_t in_tick_ = 0, longest_tick_ = 0, tick_since_ = 0, watched_from_ = 0;
  avr_cycle_count_t longest_gap_ = 0, asleep_ = 0;
  avr_cycle_count_t bitten_since_ = 0;
  int ticks_ = 0, resets_ = 0;
  bool are_interrupts_held_ = false;
  bool was_ticking_ = false, is_tick_masked_ = false;
};

}  // namespace vm
