// Greeting at the start: the board, the source of its settings, its name, `ready`.
#pragma once

#include <Settings.h>

#include "ports.h"
#include "printer.h"

namespace machine {

/// Which motor shield is plugged in, and why the firmware started. Without a shield no motor is
/// ever driven.
struct BoardName {
  uint8_t version;     ///< N of "v1.N"
  const char* driver;  ///< as the greeting names it; null: the straps are unknown
  Start start;
};

class Greeting {
 public:
  Greeting(const BoardName& board, Printer& out) : board_(board), out_(out) {}

  void sayBoard();
  void sayMotors(bool are_simulated);
  /// Says why the firmware started, unless the start was usual.
  void sayStart();
  /// Says where the settings come from, unless they are simply the stored ones.
  void saySource(const settings::Started& started);
  /// After a reset by a Grbl sender: the line that it waits for.
  void sayWelcome();
  /// Prints the lines after which clients begin to send.
  void sayReady();

 private:
  const BoardName board_;
  Printer& out_;
};

}  // namespace machine
