// Front door of the laws of motion: from a path and a feed to both chains' set-points, and from
// a set-point to the duty of its motor.
#pragma once

#include "axis_loop.h"
#include "follower.h"
