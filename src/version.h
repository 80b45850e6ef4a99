// The firmware's version, shown in the greeting. B05 answers the version that clients expect.
#pragma once

#define PLUMB_VERSION "1.0.0"
