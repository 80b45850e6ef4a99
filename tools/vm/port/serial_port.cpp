// Lets a client treat a pseudo terminal as a serial port. Linux gives it no line DTR and no parity,
// so a client that drops DTR (GroundControl) or asks for parity (WebControl) would end with an
// error. Loaded ahead of the client (LD_PRELOAD), this grants both. To raise DTR after it was
// dropped resets a board.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstring>

namespace {

int dropped_at = -1;  // the file on which DTR is down

bool isPseudoTerminal(int file) {
  const char* const path = ttyname(file);
  return path && std::strncmp(path, "/dev/pts/", 9) == 0;
}

/// Opens the port once more: the virtual machine takes each opening for a reset.
void reset(int file) {
  const int again = open(ttyname(file), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (again >= 0) close(again);
}

/// Drops or raises lines.
void change(int file, unsigned long request, int lines) {
  if (!(lines & TIOCM_DTR)) return;
  if (request == TIOCMBIS && dropped_at == file) reset(file);
  dropped_at = request == TIOCMBIC ? file : -1;
}

/// The system's function of this name.
template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int ioctl(int file, unsigned long request, ...) noexcept {
  va_list rest;
  va_start(rest, request);
  void* const argument = va_arg(rest, void*);
  va_end(rest);
  const auto system = next<int (*)(int, unsigned long, ...)>("ioctl");
  const int answer = system(file, request, argument);
  const bool is_line = request == TIOCMBIC || request == TIOCMBIS;
  if (answer != -1 || errno != ENOTTY || !is_line || !isPseudoTerminal(file)) return answer;
  change(file, request, *static_cast<const int*>(argument));
  return 0;
}

extern "C" int tcsetattr(int file, int when, const termios* wanted) noexcept {
  const auto system = next<int (*)(int, int, const termios*)>("tcsetattr");
  const int answer = system(file, when, wanted);
  if (answer != -1 || errno != EINVAL || !isPseudoTerminal(file)) return answer;
  termios without_parity = *wanted;
  without_parity.c_cflag &= ~(PARENB | PARODD);
  return system(file, when, &without_parity);
}
