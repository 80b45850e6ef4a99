// What the operator may do while the program waits: move z, ask questions, resume.
#pragma once

#include "coordinates.h"
#include "interlude.h"
#include "motor_power.h"
#include "z_axis.h"

namespace machine {

/// Does lines that are no motion, and answers lines.
class Dispatch {
 public:
  /// A B code or `$$`.
  virtual bool runQuestion(const char* line) = 0;
  /// Says `ok` if the line is done and nothing has answered it.
  virtual void answer(bool done) = 0;

 protected:
  ~Dispatch() = default;
};

/// Serves a hold or a pause from its beginning until z is back at the program's height.
class OperatorLines {
 public:
  OperatorLines(Interlude& interlude, gcode::Input& input, gcode::Modal& modal, Axes& axes,
                MotorPower& motors, ZAxis& z, const Coordinates& coordinates, Clock& clock,
                Printer& out, Answers& answers, Dispatch& dispatch)
      : interlude_(interlude),
        input_(input),
        modal_(modal),
        axes_(axes),
        motors_(motors),
        z_(z),
        coordinates_(coordinates),
        clock_(clock),
        out_(out),
        answers_(answers),
        dispatch_(dispatch) {}

  /// 0x84: the sled brakes along its path and the program waits.
  void hold();
  /// `~`.
  void resume();
  /// To be called often: does a line of the operator, or a step of z's way back.
  void serve();
  /// Whether a line may be done while the program waits.
  bool isForOperator(const char* line) const;

 private:
  bool isForOperator(const gcode::Piece& piece) const;
  bool bringZBack();
  void serveLine();
  bool run(const char* line);
  bool jogZ(const gcode::Words& words);

  Interlude& interlude_;
  gcode::Input& input_;
  gcode::Modal& modal_;
  Axes& axes_;
  MotorPower& motors_;
  ZAxis& z_;
  const Coordinates& coordinates_;
  Clock& clock_;
  Printer& out_;
  Answers& answers_;
  Dispatch& dispatch_;
};

}  // namespace machine
