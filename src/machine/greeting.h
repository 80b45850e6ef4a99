// What the machine says first: its board, where its settings come from, its name, that it is ready.
#pragma once

#include <Settings.h>

#include "ports.h"
#include "printer.h"

namespace machine {

/// Which motor shield was found, and why the firmware started; without a shield no motor is ever
/// driven.
struct BoardName {
  BoardName(uint8_t version, const char* driver, Start start = Start::kUsual)
      : version(version), driver(driver), start(start) {}
  uint8_t version;     ///< N of "v1.N"
  const char* driver;  ///< as the greeting names it; null: its straps are unknown
  Start start;
};

class Greeting {
 public:
  Greeting(const BoardName& board, Printer& out) : board_(board), out_(out) {}

  void sayBoard();
  void sayMotors(bool are_simulated);
  /// Why it started, if that is not as usual.
  void sayStart();
  /// Where the settings come from, if they are not as they were left.
  void saySource(const settings::Started& started);
  /// After this line the clients send.
  void sayReady();

 private:
  const BoardName board_;
  Printer& out_;
};

}  // namespace machine
