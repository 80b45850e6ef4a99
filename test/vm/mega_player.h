// Plays a dialogue with the flashed program on a simulated Mega: it may look at the Mega itself
// too.
#pragma once

#include <memory>

#include "brain/mega_brain.h"
#include "test_dialogues/player.h"

namespace vm {

class Stream;

/// Asks and disturbs the Mega too. It prints measured figures, a line each.
class MegaPlayer : public Player {
 public:
  MegaPlayer(std::vector<Step> steps, world::World& world, brain::MegaBrain& mega);
  ~MegaPlayer() override;

  void tellFigures();

 protected:
  bool askBoard(const std::string& verb, const Words& words) override;
  void start() override;

 private:
  bool disturbProgram(const std::string& verb, const Words& words);
  bool freeze(const std::string& where);
  bool stream(const Words& words);
  bool readTelemetry();
  bool measure(double seconds);
  void tellTicks(const char* when);

  brain::MegaBrain& mega_;
  std::unique_ptr<Stream> stream_;
  bool is_asking_ = false;  ///< in the middle of a question that takes time
  int straps_ = -1;         ///< of the next life; -1: those of the shield
};

}  // namespace vm
