# Lets CMake compile the package's modules for Windows on Debian.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
# The package brings all that MinGW links.
set(CMAKE_SHARED_LINKER_FLAGS "-static -s")
set(CMAKE_MODULE_LINKER_FLAGS "-static -s")
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
