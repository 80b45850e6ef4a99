// Chains paid out and wound in, and z against the probe.
#include "parts.h"

namespace machine {
namespace {

const float kAxisFeed = 800;  // [mm/min] unless a command says otherwise
// The clients send F1 in the units in force; the published firmware ignores it too.
const float kProbeFeed = 60;  // [mm/min]
const char kChainLetters[] = {'L', 'R'};

}  // namespace

bool SingleAxis::move(Axis axis, float goal, float feed, Until until) {
  if (!parts_.waiting.drain() || !parts_.motors.wake()) return false;
  parts_.planner.standAt(parts_.axes.setPoint());
  parts_.planner.addAxis(axis, goal, feed / 60);
  bool ended = false;
  // A stop brakes along the path, so this goes on until the axis stands still.
  while (parts_.waiting.isMoving() && !ended) {
    ended = until != Until::kGoal && parts_.aux.probeTouches() == (until == Until::kTouch);
    parts_.waiting.pass();
  }
  if (ended) {
    const Place& at = parts_.program.aim();
    probed_ = {at.x, at.y, parts_.axes.length(axis)};
    parts_.planner.forget();
    parts_.axes.dropSetPoints();
  }
  parts_.waiting.settle();
  parts_.planner.standAt(parts_.axes.setPoint());
  return !parts_.waiting.isStopping() && (ended || until == Until::kGoal);
}

bool SingleAxis::measureOut(Axis axis) {
  if (!isLength(parts_.values.at(kExtendLength)))
    return parts_.answers.refuseMotion(FLASH("no chain is that long ($11)"));
  if (!parts_.motors.doChainsFollow()) return false;
  parts_.out.line(axis == kLeftAxis ? FLASH("Measuring out left chain")
                                    : FLASH("Measuring out right chain"));
  const bool completed =
      move(axis, parts_.values.at(kExtendLength), 0.9f * parts_.values.at(kGreatestFeed));
  parts_.axes.release(axis);
  parts_.place.search(Search::kChainsDriven);
  if (!completed) return false;
  parts_.out.fixed(parts_.axes.length(axis), 2).line(FLASH("mm"));
  return true;
}

bool SingleAxis::mayHang(float left, float right) {
  const float kFarOff = 500;  // [mm] no sled is so far beyond the sheet while it is measured
  const FoundPlace found = parts_.geometry.forward(left, right, {0, 0});
  if (!found.found || !(parts_.geometry.sheet().distanceTo(found.at) > kFarOff)) return true;
  parts_.answers.beginError(grbl::kTravel);
  parts_.out << FLASH("such chains put the sled at X");
  parts_.out.fixed(found.at.x, 0) << FLASH(" Y");
  parts_.out.fixed(found.at.y, 0)
      .line(FLASH(", far off the sheet: measure again, or check the settings"));
  return false;
}

bool SingleAxis::setChains(float left, float right) {
  if (!isLength(left) || !isLength(right)) return parts_.answers.refuseMotion(tooLongForChains());
  parts_.axes.declare(kLeftAxis, left);
  parts_.axes.declare(kRightAxis, right);
  parts_.out << FLASH("Left: ");
  parts_.out.fixed(parts_.axes.length(kLeftAxis), 2).line(FLASH("mm"));
  parts_.out << FLASH("Right: ");
  parts_.out.fixed(parts_.axes.length(kRightAxis), 2).line(FLASH("mm"));
  parts_.keeper.declareChains();
  parts_.place.search(Search::kDeclared);
  return true;
}

bool SingleAxis::setChainsToMarks() {
  const float length = parts_.values.at(kExtendLength);
  if (!setChains(length, length)) return false;
  parts_.out.line(FLASH("Message: The machine chains have been manually re-calibrated."));
  return true;
}

bool SingleAxis::moveChains(const gcode::Words& words) {
  if (!parts_.motors.goOnFromHere() || !parts_.motors.doChainsFollow()) return false;
  const float feed = words.value('F') > 0 ? words.value('F') : kAxisFeed;
  float goals[2];
  for (uint8_t i = 0; i < 2; ++i) {
    const float is = parts_.axes.target(Axis(i)), given = words.value(kChainLetters[i]);
    // A chain without a word stays.
    goals[i] = !words.has(kChainLetters[i]) ? is : parts_.modal.relative ? is + given : given;
    if (!isLength(goals[i])) return parts_.answers.refuseMotion(tooLongForChains());
  }
  bool completed = true;
  for (uint8_t i = 0; i < 2; ++i)
    if (goals[i] != parts_.axes.target(Axis(i)))
      completed = completed && move(Axis(i), goals[i], feed);
  parts_.place.search(Search::kChainsDriven);
  return completed;
}

bool SingleAxis::goHome() {
  if (!parts_.place.isKnown()) return parts_.answers.refuseMotion(parts_.place.whatIsLost());
  if (!parts_.motors.goOnFromHere() || !parts_.motors.doChainsFollow()) return false;
  const motion::Lengths<float> lengths = parts_.geometry.inverse({0, 0});
  if (!lengths.reachable)
    return parts_.answers.refuseMotion(FLASH("with these settings no sled can hang at 0,0"));
  const bool completed =
      move(kLeftAxis, lengths.left, kAxisFeed) && move(kRightAxis, lengths.right, kAxisFeed);
  if (completed) parts_.place.search(Search::kCentred);
  return completed;
}

bool SingleAxis::measureChain(bool left) {
  parts_.out << FLASH("[Measure: ");
  parts_.out.fixed(parts_.axes.length(left ? kLeftAxis : kRightAxis), 2).line(FLASH("]"));
  return true;
}

void SingleAxis::sayProbing(float target, float feed) {
  parts_.out.line(FLASH("probing for z axis zero"));
  parts_.out << FLASH("max depth ");
  parts_.out.fixed(parts_.modal.fromMm(target), 2)
      .line(parts_.modal.inches ? FLASH(" in.") : FLASH(" mm."));
  parts_.out << FLASH("feedrate ");
  parts_.out.fixed(parts_.modal.fromMm(feed), 2);
  parts_.out.line(parts_.modal.inches ? FLASH(" in per min.") : FLASH(" mm per min."));
}

bool SingleAxis::probe(float target, bool until_touch, bool must) {
  if (!parts_.z.hasMotor())
    return parts_.answers.refuseMotion(FLASH("a probe needs a z motor ($16)"));
  if (!parts_.motors.goOnFromHere() || !parts_.motors.doesZFollow()) return false;
  if (!ZAxis::reaches(target)) return parts_.answers.refuseMotion(tooLongForZ());
  if (!parts_.waiting.drain()) return false;
  has_probed_ = false;
  if (parts_.aux.probeTouches() == until_touch)
    return parts_.answers.refuseMotion(
        until_touch ? FLASH("the probe touches already: lift z, or look for a short")
                    : FLASH("the probe touches nothing already"));
  const float feed = parts_.z.mostFeed() < kProbeFeed ? parts_.z.mostFeed() : kProbeFeed;
  sayProbing(target, feed);
  has_probed_ = move(kZAxis, target, feed, until_touch ? Until::kTouch : Until::kLetGo);
  if (parts_.waiting.isStopping()) return false;
  if (has_probed_ && (!parts_.out.speaksGrbl() || !parts_.keeper.trusts(kZAxis))) {
    // The axis ran on for a moment.
    parts_.z.declare(parts_.axes.length(kZAxis) - probed_.z);
    probed_.z = 0;
    parts_.out.line(FLASH("z axis zeroed"));
    return true;
  }
  parts_.place.standHere();
  return has_probed_ || !must || parts_.answers.refuseMotion(FLASH("probe did not connect"));
}

void SingleAxis::sayProbed() {
  parts_.out << FLASH("[PRB:");
  parts_.reports.sayPlace(probed_);
  parts_.out.line(has_probed_ ? FLASH(":1]") : FLASH(":0]"));
}

}  // namespace machine
