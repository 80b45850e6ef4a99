// The frame's numbers by name, for host tools only.
#pragma once

#include "strand.h"

namespace kinematics {

/// A number of the frame: its field and its texts.
template <class Real>
struct FrameField {
  const char* name;
  const char* unit;
  Real Frame<Real>::*member;
  double usual;      ///< the published default
  double low, high;  ///< a value outside these is refused as a mistake
  const char* summary;
  const char* noun;  ///< in plain words
};

enum { kFrameFieldCount = 7 };

/// All numbers of the frame, in the order of Frame.
template <class Real>
const FrameField<Real>* frameFields() {
  static const FrameField<Real> fields[kFrameFieldCount] = {
      {"motor_gap", "mm", &Frame<Real>::motor_gap, 2978.4, 1000, 6000,
       "distance of the sprocket centres", "gap between the motors"},
      {"motor_height", "mm", &Frame<Real>::motor_height, 1072.6, 300, 4000,
       "sprocket centres above the middle of the sheet", "motors above the middle of the sheet"},
      {"motor_center_x", "mm", &Frame<Real>::motor_center_x, 0, -500, 500,
       "middle of the sprockets, right of the middle of the sheet",
       "motors right of the middle of the sheet"},
      {"rotation_radius", "mm", &Frame<Real>::rotation_radius, 139.1, 0, 400,
       "from the bit to the end of each chain: ring and link; measure it, do not fit it",
       "bit to the end of each chain"},
      {"sprocket_radius", "mm", &Frame<Real>::sprocket_radius, 10.1063, 3, 50,
       "chain fed per radian: teeth * pitch / (2 pi)", "radius of the sprockets"},
      {"sled_weight", "N", &Frame<Real>::sled_weight, 97.9, 10, 500,
       "sled, router and bricks, as far as the chains carry it", "weight of the sled"},
      {"chain_weight", "N/mm", &Frame<Real>::chain_weight, 0.00137293, 0, 0.01,
       "one millimetre of chain", "weight of the chain"},
  };
  return fields;
}

}  // namespace kinematics
