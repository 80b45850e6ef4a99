// Which codes change a mode, and which only confirm what is always so.
#include "modal.h"

namespace gcode {

void Modal::beginLine() {
  machine_coordinates = false;
  inverse_feed = 0;
}

void Modal::endProgram() {
  plane = 17;
  system = 0;
  inverse_time = false;
  if (motion >= kNoMotion) motion = 0;
}

bool Modal::take(uint16_t tenths) {
  switch (tenths) {
    case 170:
    case 180:
    case 190:
      plane = uint8_t(tenths / 10);
      return true;
    case 200:
    case 210:
      inches = tenths == 200;
      return true;
    case 530:
      machine_coordinates = true;
      return true;
    case 540:
    case 550:
    case 560:
    case 570:
    case 580:
    case 590:
      system = uint8_t(tenths / 10 - 54);
      return true;
    case 800:
      motion = kNoMotion;
      return true;
    case 900:
    case 910:
      relative = tenths == 910;
      return true;
    case 901:
    case 911:
      absolute_centres = tenths == 901;
      return true;
    case 930:
    case 940:
      inverse_time = tenths == 930;
      return true;
    case 980:
    case 990:
      retracts_to_r = tenths == 990;
      return true;
    // Always so: cutter compensation, scaling, rotation and polar words are off, spindle speed is
    // in turns a minute, corners are passed within a fixed distance.
    case 150:
    case 400:
    case 500:
    case 610:
    case 640:
    case 690:
    case 970:
      return true;
    default:
      return false;
  }
}

}  // namespace gcode
