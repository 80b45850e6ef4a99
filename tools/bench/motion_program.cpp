// Moves along lines and arcs over the sheet on the (simulated) Mega at 900 mm/min, with the default
// machine's exact inverse; marks as in board_program.cpp.
#include <Motion.h>
#include <avr/io.h>
#include <avr/sleep.h>

#include "Kinematics.h"
#include "motion_cases.h"

using kinematics::EffectParams;
using kinematics::Feed;
using kinematics::Found;
using kinematics::Frame;
using kinematics::Machine;
using kinematics::PaidOut;
using motion::Lengths;
using motion::Mover;
using motion::Path;
using motion::Point;
using motion::SetPoint;
using motion::SetPoints;

namespace {

// The compiler must not move work across a mark.
#define BARRIER() __asm__ __volatile__("" ::: "memory")

const float kHalfWidth = 1219.2f, kHalfHeight = 609.6f;       // [mm]
const float kHalfGap = 1489.2f, kMotorHeight = 609.6f + 463;  // [mm]
const float kTick = 0.01f, kFeed = 15;                        // [s], [mm/s]
const float kStep = kFeed * kTick;                            // [mm]
const float kShort = 0.2f;                                    // [mm] of a short move
const float kSag = 6.2f;                                      // [mm] in a lower corner
const float kMoveLength = 120;                                // [mm]

volatile int32_t left, right;
volatile bool failed;
Machine<float> machine;

/// Sag, stretch and pitch as on the default machine.
struct TypicalSizes {
  float* next;

  template <class ThisEffect>
  void effect(int first_setting) {
    const bool present = first_setting >= 160 && first_setting <= 180;
    for (uint8_t i = 0; i < ThisEffect::kParamCount; ++i)
      *next++ = present ? float(ThisEffect::param(i).typical) : 0.0f;
  }
};

void prepareMachine() {
  const Frame<float> frame = {2978.4f,  kMotorHeight, 0.0f,        139.1f,
                              10.1063f, 97.9f,        0.00137293f, Feed::kOverTop};
  EffectParams<float> effects;
  TypicalSizes sizes = {effects.value};
  kinematics::Effects::For<float>::visit(sizes);
  machine = prepare(frame, effects);
}

struct Exactly {
  Lengths<float> operator()(Point<float> place) const {
    const PaidOut<float> paid = inverse(machine, kinematics::Point<float>{place.x, place.y});
    return {paid.chains.left, paid.chains.right, paid.found == Found::kYes};
  }
};

const Exactly exactly;

/// The timed move from a place of the grid: inwards and down, or around a circle there.
Path<float> pathFrom(const bench::Case& timed, Point<float> at) {
  const float inwards = at.x > 0 ? -1 : 1;
  if (timed.shape == bench::kLine)
    return motion::line(
        at, Point<float>{at.x + inwards * kMoveLength * 0.8f, at.y - kMoveLength * 0.6f});
  const float radius = timed.radius;
  const float turn = kMoveLength / radius;
  const Point<float> centre = {at.x, at.y};
  const Point<float> from = {at.x + radius, at.y};
  const Point<float> to = {at.x + radius * float(cos(turn)), at.y + radius * float(sin(turn))};
  return motion::arc(from, to, centre, motion::Turn::kCounterclockwise);
}

void begin(Mover& mover, Point<float> at) {
  const motion::Knot knot = knotAt(exactly, at).knot;
  mover.prepare({100, 10, 20, 0.66f, 0.05f}, kTick);
  mover.setSprockets({{-kHalfGap, kMotorHeight},
                      {kHalfGap, kMotorHeight},
                      motion::sagSlopes(kSag, kHalfGap + kHalfWidth, kHalfGap - kHalfWidth,
                                        kMotorHeight + kHalfHeight, 3186.0f)});
  mover.setArea({kHalfWidth, kHalfHeight});
  mover.standAt({knot.left, knot.right, 0});
}

/// The control tick's part.
void take(SetPoints& set_points) {
  static motion::Playback playback;
  SetPoint point = {0, 0, 0};
  playback.next(set_points, point);
  left = point.left;
  right = point.right;
}

/// The main program's part of a tick, and the control tick's part.
void tick(Mover& mover, SetPoints& set_points) {
  if (mover.fill(set_points, exactly) != motion::Filled::kYes) failed = true;
  take(set_points);
}

/// Sleeps with interrupts off: the simulator reports it.
void giveUp() {
  sleep_enable();
  sleep_cpu();
}

void mark(uint8_t number) {
  BARRIER();
  GPIOR0 = number;
  BARRIER();
}

/// Short moves in a row, with a tick for every move's share of time.
void timeShortMoves(uint8_t number, Mover& mover, SetPoints& set_points, Point<float> at) {
  const bench::Case& timed = bench::kCases[number];
  const float inwards = at.x > 0 ? -1 : 1;
  uint16_t ticks = 0;
  mark(number + 1);
  for (uint16_t i = 0; i < timed.ticks; ++i) {
    const Point<float> to = {at.x + inwards * 0.8f * kShort, at.y - 0.6f * kShort};
    mover.add(motion::line(at, to), 0, kFeed);
    at = to;
    for (; float(ticks) * kStep < float(i) * kShort; ++ticks) tick(mover, set_points);
  }
  mark(0);
}

void timeOne(uint8_t number, Point<float> at) {
  const bench::Case& timed = bench::kCases[number];
  const Path<float> path = pathFrom(timed, at);
  Mover mover;
  SetPoints set_points;
  begin(mover, path.from);
  if (timed.what == bench::kShortMoves) return timeShortMoves(number, mover, set_points, path.from);
  if (timed.what == bench::kNothing) {
    mark(number + 1);
    mark(0);
    return;
  }
  if (timed.what == bench::kMove) mark(number + 1);
  failed = mover.add(path, 0, kFeed) != motion::Added::kYes;
  if (timed.what == bench::kMove) {
    for (uint16_t i = 0; i < timed.ticks; ++i) tick(mover, set_points);
    mark(0);
    failed = failed || !mover.isIdle();
    return;
  }
  for (uint16_t i = 0; i < 300; ++i) {
    if (timed.what == bench::kTick) mark(number + 1);
    mover.fill(set_points, exactly);
    if (timed.what == bench::kTake) mark(number + 1);
    take(set_points);
    mark(0);
  }
}

}  // namespace

int main() {
  prepareMachine();
  for (uint8_t i = 0; i < bench::kCaseCount; ++i)
    for (uint8_t column = 0; column < bench::kColumns; ++column)
      for (uint8_t row = 0; row < bench::kRows; ++row) {
        timeOne(i, {-1100.0f + 2200.0f * column / (bench::kColumns - 1),
                    -500.0f + 1000.0f * row / (bench::kRows - 1)});
        if (failed) giveUp();
      }
  GPIOR0 = bench::kFinished;
  for (;;) {
  }
}
