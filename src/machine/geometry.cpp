// Turns settings in their published meaning into the frame and the effects of the kinematics.
#include "geometry.h"

#include "effective.h"

namespace machine {
namespace {

using kinematics::Found;
using settings::Values;

// The bound for segments assumes these where the exact inverse gives none: slopes for a sled that
// tilts, and sag on a machine whose lower corners are out of reach.
const motion::Slopes<float> kBracketSlopes = {0.3f, 5e-4f, 5e-6f};
const float kUnknownSag = 20;  // [mm]

typedef kinematics::Effects::For<float> Effects;

/// Bounds for the slopes of an error that repeats with each turn of the sprockets.
motion::Slopes<float> waveSlopes(float amplitude, float radius) {
  const float per = 1 / radius;
  return {amplitude * per, amplitude * per * per, amplitude * per * per * per};
}

}  // namespace

void Geometry::prepare(const Values& values) {
  const kinematics::Frame<float> frame = frameOf(values);
  half_width_ = values.at(kSheetWidth) / 2;
  half_height_ = values.at(kSheetHeight) / 2;
  chain_length_ = values.at(kChainLength);
  weight_torque_ = frame.sled_weight * frame.sprocket_radius;
  sprockets_.left = {frame.motor_center_x - frame.motor_gap / 2, frame.motor_height};
  sprockets_.right = {frame.motor_center_x + frame.motor_gap / 2, frame.motor_height};
  has_brackets_ = values.at(kKinematics) == 1;
  if (has_brackets_)
    prepareBrackets(values, frame);
  else
    prepareRing(values, frame);
  is_sheet_reachable_ = isSheetReachable();
}

bool Geometry::isSheetReachable() const {
  // If a corner or the middle of the top edge is out of reach, every target is checked.
  for (int8_t x = -1; x <= 1; ++x)
    for (int8_t y = -1; y <= 1; y = int8_t(y + 2))
      if (!inverse({float(x) * half_width_, float(y) * half_height_}).reachable) return false;
  return true;
}

float Geometry::shapeRing(const Values& values, bool bends) {
  ::Geometry shape = geometryOf(values);
  const float waves = Effects::wavesOf(shape.effects.value);
  if (!bends) Effects::clearBends(shape.effects.value);
  ring_ = kinematics::prepare(shape.frame, shape.effects);
  return waves;
}

void Geometry::prepareRing(const Values& values, const kinematics::Frame<float>& frame) {
  const kinematics::Point<float> corner = {half_width_, -half_height_};
  shapeRing(values, false);
  const kinematics::PaidOut<float> straight = kinematics::inverse(ring_, corner);
  const float wave_size = shapeRing(values, true);
  const kinematics::PaidOut<float> bent = kinematics::inverse(ring_, corner);
  const bool both_hang = straight.found == Found::kYes && bent.found == Found::kYes;
  const float sag = both_hang ? float(fabs(bent.chains.left - straight.chains.left)) : kUnknownSag;
  const float far_run = sprockets_.right.x + half_width_;
  const float near_run = sprockets_.right.x - half_width_;
  const float drop = frame.motor_height + half_height_;
  // On a sheet as wide as the frame no chain could hold the corner.
  const float least_run = near_run > 50 ? near_run : 50;
  const float span = float(sqrt(far_run * far_run + drop * drop));
  sprockets_.effects = motion::sagSlopes(sag, far_run, least_run, drop, span);
  const motion::Slopes<float> waves = waveSlopes(wave_size, frame.sprocket_radius);
  sprockets_.effects.first += waves.first;
  sprockets_.effects.second += waves.second;
  sprockets_.effects.third += waves.third;
}

void Geometry::prepareBrackets(const Values& values, const kinematics::Frame<float>& frame) {
  brackets_ = kinematics::prepare(frame, bracketSledOf(values), pitchOf(values));
  sprockets_.effects = kBracketSlopes;
}

motion::Lengths<float> Geometry::inverse(motion::Point<float> place) const {
  const kinematics::Point<float> bit = {place.x, place.y};
  kinematics::Chains<float> chains;
  Found found;
  if (has_brackets_) {
    const kinematics::TiltedPaidOut<float> paid = kinematics::inverse(brackets_, bit);
    chains = paid.chains;
    found = paid.found;
  } else {
    const kinematics::PaidOut<float> paid = kinematics::inverse(ring_, bit);
    chains = paid.chains;
    found = paid.found;
  }
  const bool reachable = found == Found::kYes && isChain(chains.left) && isChain(chains.right);
  return {chains.left, chains.right, reachable};
}

float Geometry::torqueAt(motion::Point<float> place) const {
  const float up = sprockets_.left.y - place.y;
  const float to_left = place.x - sprockets_.left.x, to_right = sprockets_.right.x - place.x;
  // The level pulls of both chains are alike, and the upright pulls carry the sled.
  const float left = to_right * float(sqrt(to_left * to_left + up * up));
  const float right = to_left * float(sqrt(to_right * to_right + up * up));
  return weight_torque_ * (left > right ? left : right) / (up * (to_left + to_right));
}

FoundPlace Geometry::forward(float left, float right, motion::Point<float> guess) const {
  const kinematics::Chains<float> chains = {left, right};
  const kinematics::Point<float> near = {guess.x, guess.y};
  if (has_brackets_) {
    kinematics::TiltedPlace<float> place = kinematics::forward(brackets_, chains, near, 0.0f);
    if (place.found != Found::kYes) place = kinematics::forward(brackets_, chains);
    return {{place.sled.x, place.sled.y}, place.found == Found::kYes};
  }
  kinematics::Place<float> place = kinematics::forward(ring_, chains, near);
  if (place.found != Found::kYes) place = kinematics::forward(ring_, chains);
  return {{place.sled.x, place.sled.y}, place.found == Found::kYes};
}

}  // namespace machine
