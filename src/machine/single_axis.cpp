// Chains paid out and wound in, and z against the probe.
#include "single_axis.h"

namespace machine {
namespace {

const float kAxisFeed = 800;  // [mm/min] unless a command says otherwise
// The clients send F1 in the units in force; the published firmware ignores it too.
const float kProbeFeed = 60;  // [mm/min]
const char kChainLetters[] = {'L', 'R'};

}  // namespace

bool SingleAxis::move(Axis axis, float goal, float feed, Until until) {
  if (!base_.waiting.drain() || !motors_.wake()) return false;
  base_.planner.standAt(base_.axes.setPoint());
  base_.planner.addAxis(axis, goal, feed / 60);
  bool ended = false;
  // A stop brakes along the path, so this goes on until the axis stands still.
  while (base_.waiting.isMoving() && !ended) {
    ended = until != Until::kGoal && base_.aux.probeTouches() == (until == Until::kTouch);
    base_.waiting.pass();
  }
  if (ended) {
    const Place& at = base_.program.aim();
    probed_ = {at.x, at.y, base_.axes.length(axis)};
    base_.planner.forget();
    base_.axes.dropSetPoints();
  }
  base_.waiting.settle();
  base_.planner.standAt(base_.axes.setPoint());
  return !base_.waiting.isStopping() && (ended || until == Until::kGoal);
}

bool SingleAxis::measureOut(Axis axis) {
  if (!isLength(base_.values.at(kExtendLength)))
    return base_.answers.refuseMotion(FLASH("no chain is that long ($11)"));
  if (!door_.doChainsFollow()) return false;
  base_.out.line(axis == kLeftAxis ? FLASH("Measuring out left chain")
                                   : FLASH("Measuring out right chain"));
  const bool completed =
      move(axis, base_.values.at(kExtendLength), 0.9f * base_.values.at(kGreatestFeed));
  base_.axes.release(axis);
  place_.search(Search::kChainsDriven);
  if (!completed) return false;
  base_.out.fixed(base_.axes.length(axis), 2).line(FLASH("mm"));
  return true;
}

bool SingleAxis::mayHang(float left, float right) {
  const float kFarOff = 500;  // [mm] no sled is so far beyond the sheet while it is measured
  const FoundPlace found = base_.geometry.forward(left, right, {0, 0});
  if (!found.found || !(base_.geometry.sheet().distanceTo(found.at) > kFarOff)) return true;
  base_.answers.beginError(grbl::kTravel);
  base_.out << FLASH("such chains put the sled at X");
  base_.out.fixed(found.at.x, 0) << FLASH(" Y");
  base_.out.fixed(found.at.y, 0)
      .line(FLASH(", far off the sheet: measure again, or check the settings"));
  return false;
}

bool SingleAxis::setChains(float left, float right) {
  if (!isLength(left) || !isLength(right)) return base_.answers.refuseMotion(tooLongForChains());
  base_.axes.declare(kLeftAxis, left);
  base_.axes.declare(kRightAxis, right);
  base_.out << FLASH("Left: ");
  base_.out.fixed(base_.axes.length(kLeftAxis), 2).line(FLASH("mm"));
  base_.out << FLASH("Right: ");
  base_.out.fixed(base_.axes.length(kRightAxis), 2).line(FLASH("mm"));
  base_.keeper.declareChains();
  place_.search(Search::kDeclared);
  return true;
}

bool SingleAxis::setChainsToMarks() {
  const float length = base_.values.at(kExtendLength);
  if (!setChains(length, length)) return false;
  base_.out.line(FLASH("Message: The machine chains have been manually re-calibrated."));
  return true;
}

bool SingleAxis::moveChains(const gcode::Words& words) {
  if (!door_.goesOnFromHere() || !door_.doChainsFollow()) return false;
  const float feed = words.value('F') > 0 ? words.value('F') : kAxisFeed;
  float goals[2];
  for (uint8_t i = 0; i < 2; ++i) {
    const float is = base_.axes.target(Axis(i)), given = words.value(kChainLetters[i]);
    // A chain without a word stays.
    goals[i] = !words.has(kChainLetters[i]) ? is : base_.modal.relative ? is + given : given;
    if (!isLength(goals[i])) return base_.answers.refuseMotion(tooLongForChains());
  }
  bool completed = true;
  for (uint8_t i = 0; i < 2; ++i)
    if (goals[i] != base_.axes.target(Axis(i)))
      completed = completed && move(Axis(i), goals[i], feed);
  place_.search(Search::kChainsDriven);
  return completed;
}

bool SingleAxis::goHome() {
  if (!place_.isKnown()) return base_.answers.refuseMotion(place_.whatIsLost());
  if (!door_.goesOnFromHere() || !door_.doChainsFollow()) return false;
  const motion::Lengths<float> lengths = base_.geometry.inverse({0, 0});
  if (!lengths.reachable)
    return base_.answers.refuseMotion(FLASH("with these settings no sled can hang at 0,0"));
  const bool completed =
      move(kLeftAxis, lengths.left, kAxisFeed) && move(kRightAxis, lengths.right, kAxisFeed);
  if (completed) place_.search(Search::kCentred);
  return completed;
}

bool SingleAxis::measureChain(bool left) {
  base_.out << FLASH("[Measure: ");
  base_.out.fixed(base_.axes.length(left ? kLeftAxis : kRightAxis), 2).line(FLASH("]"));
  return true;
}

void SingleAxis::sayProbing(float target, float feed) {
  base_.out.line(FLASH("probing for z axis zero"));
  base_.out << FLASH("max depth ");
  base_.out.fixed(base_.modal.fromMm(target), 2)
      .line(base_.modal.inches ? FLASH(" in.") : FLASH(" mm."));
  base_.out << FLASH("feedrate ");
  base_.out.fixed(base_.modal.fromMm(feed), 2);
  base_.out.line(base_.modal.inches ? FLASH(" in per min.") : FLASH(" mm per min."));
}

bool SingleAxis::probe(float target, bool until_touch, bool must) {
  if (!z_.hasMotor()) return base_.answers.refuseMotion(FLASH("a probe needs a z motor ($16)"));
  if (!door_.goesOnFromHere() || !door_.doesZFollow()) return false;
  if (!ZAxis::reaches(target)) return base_.answers.refuseMotion(tooLongForZ());
  if (!base_.waiting.drain()) return false;
  has_probed_ = false;
  if (base_.aux.probeTouches() == until_touch)
    return base_.answers.refuseMotion(
        until_touch ? FLASH("the probe touches already: lift z, or look for a short")
                    : FLASH("the probe touches nothing already"));
  const float feed = z_.mostFeed() < kProbeFeed ? z_.mostFeed() : kProbeFeed;
  sayProbing(target, feed);
  has_probed_ = move(kZAxis, target, feed, until_touch ? Until::kTouch : Until::kLetGo);
  if (base_.waiting.isStopping()) return false;
  if (has_probed_ && (!base_.out.speaksGrbl() || !base_.keeper.trusts(kZAxis))) {
    // The axis ran on for a moment.
    z_.declare(base_.axes.length(kZAxis) - probed_.z);
    probed_.z = 0;
    base_.out.line(FLASH("z axis zeroed"));
    return true;
  }
  place_.standHere();
  return has_probed_ || !must || base_.answers.refuseMotion(FLASH("probe did not connect"));
}

void SingleAxis::sayProbed() {
  base_.out << FLASH("[PRB:");
  reports_.sayPlace(probed_);
  base_.out.line(has_probed_ ? FLASH(":1]") : FLASH(":0]"));
}

}  // namespace machine
