// Front door of the laws of motion: from a path and a feed to both chains' set-points.
#pragma once

#include "follower.h"
