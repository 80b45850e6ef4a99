// G0 to G3: from words to paths in the queue.
#pragma once

#include "edge_cut.h"
#include "operator_lines.h"

namespace machine {

/// Lines and arcs over the sheet. Functions return false if the move was refused or stopped.
class Moves {
 public:
  explicit Moves(Parts& parts) : parts_(parts) {}

  /// Takes an F word.
  void takeFeed(const gcode::Words& words);
  /// The feed of G0 to G3 [mm/min]. With G93 it is negative: -1 / the move's time [1/min].
  float feedOf(uint8_t kind) const;
  /// The target of a line's words.
  Place targetOf(const gcode::Words& words) const;
  /// G0 to G3.
  bool move(uint8_t kind, const gcode::Words& words);
  /// A straight move; `feed` [mm/min], or -1 / the move's time [1/min].
  bool moveStraight(Place target, bool across, float feed);
  /// G28 and G30: moves up, then across, then down.
  bool goToKept(const gcode::Piece& piece);

 private:
  bool goSafely(const Place& target, bool across);
  bool isNear(const Place& target);
  bool mayTurn(const gcode::Words& words);
  Place placeOf(const gcode::Words& words) const;
  float centreAhead(const gcode::Words& words, uint8_t axis) const;
  // Not inline: else every line would wait for room with the stack of an arc, and an arc with the
  // stack of what draws it.
  __attribute__((noinline)) bool moveRound(uint8_t kind, const Place& target,
                                           const gcode::Words& words, float feed);
  __attribute__((noinline)) bool drawRound(uint8_t kind, Place target, const gcode::Words& words,
                                           motion::Path<float>& path);
  bool queueChords(const motion::Path<float>& path, const Place& target, float feed);
  __attribute__((noinline)) bool queueChord(const motion::Path<float>& path, float share,
                                            float start, float way, float feed);
  float fittingFeed(float length, float rise, float times) const;
  bool queue(const motion::Path<float>& path, const Place& target, float feed);
  __attribute__((noinline)) bool mayGo(const motion::Path<float>& path, const Area& area);
  // Not inline: else the wait for room would have the stack of the cuts.
  __attribute__((noinline)) bool queueCut(const motion::Path<float>& path, float z_to, float feed,
                                          uint8_t beam);
  bool awaitRoom(uint8_t pieces);
  bool queuePieces(EdgeCut& cut, float z_to, float feed, uint8_t beam);
  bool queuePiece(const motion::Path<float>& piece, motion::Space space, float z, float feed,
                  uint8_t beam);
  void sayBeyondSheet(motion::Point<float> end);

  Parts& parts_;
};

}  // namespace machine
