// Runs a fuzz target where there is no libFuzzer: mutates a corpus, keeps what reaches new edges,
// writes the input of a crash into a file.
//
// DRIVER FOLDER LENGTH [SEED] fuzzes; DRIVER FILE runs a single input. A length is a
// number of runs, whose inputs are the same on every machine, or a time: 600s.
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

#include "mutator.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size);

namespace {

const std::size_t kMapSize = 1 << 16;
const unsigned kPatience = 60;  // [s] for an input
uint8_t edges_now[kMapSize], edges_seen[kMapSize];
uintptr_t last_place = 0;
Input current;

void keepCurrent() {
  std::ofstream("crash.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(current.data()), std::streamsize(current.size()));
  std::fprintf(stderr, "the input is kept in crash.bin (%zu bytes)\n", current.size());
}

void onSignal(int signal) {
  std::fprintf(stderr, signal == SIGALRM ? "\nFound: an endless loop\n" : "\nstopped\n");
  keepCurrent();
  _exit(1);
}

/// How often an edge was passed, in eight classes.
uint8_t classOf(uint8_t count) {
  uint8_t bit = 0;
  while (count > 1) count = uint8_t(count >> 1), ++bit;
  return uint8_t(1 << bit);
}

/// Whether the last run passed an edge that no run had passed, or passed an edge far more often.
bool isNew() {
  bool found = false;
  for (std::size_t i = 0; i < kMapSize; ++i) {
    if (edges_now[i] == 0) continue;
    const uint8_t bits = classOf(edges_now[i]);
    found = found || (bits & ~edges_seen[i]) != 0;
    edges_seen[i] = uint8_t(edges_seen[i] | bits);
  }
  return found;
}

bool run(const Input& input) {
  current = input;
  std::memset(edges_now, 0, sizeof edges_now);
  alarm(kPatience);
  LLVMFuzzerTestOneInput(current.data(), current.size());
  alarm(0);
  return isNew();
}

std::size_t edgeCount() {
  std::size_t count = 0;
  for (const uint8_t bits : edges_seen) count += bits != 0;
  return count;
}

/// How long to fuzz: `runs`, or if these are zero `seconds`.
struct Length {
  explicit Length(const std::string& text)
      : runs(text.back() == 's' ? 0 : std::atol(text.c_str())), seconds(std::atof(text.c_str())) {}
  bool isOver(long ran, double since) const { return runs > 0 ? ran >= runs : since >= seconds; }

  long runs;
  double seconds;
};

int fuzz(const char* folder, const Length& length, unsigned seed) {
  Corpus corpus = readCorpus(folder);
  if (corpus.empty()) {
    std::fprintf(stderr, "%s holds no corpus\n", folder);
    return 2;
  }
  for (const Input& input : corpus) run(input);
  const std::size_t first = corpus.size();
  Mutator mutator(seed);
  const auto start = std::chrono::steady_clock::now();
  const auto since = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  long runs = 0;
  for (; !length.isOver(runs, since()); ++runs) {
    const Input input = mutator.next(corpus);
    if (run(input)) corpus.push_back(input);
  }
  std::printf("%s: %ld runs in %.0f s, %zu inputs grew to %zu, %zu edges, nothing found\n", folder,
              runs, since(), first, corpus.size(), edgeCount());
  return 0;
}

}  // namespace

extern "C" __attribute__((no_sanitize("address", "undefined"))) void __sanitizer_cov_trace_pc() {
  const uintptr_t place = reinterpret_cast<uintptr_t>(__builtin_return_address(0));
  const std::size_t edge = (place ^ (last_place * 31)) % kMapSize;
  if (edges_now[edge] != 255) ++edges_now[edge];
  last_place = place >> 1;
}

// A finding of the sanitizers aborts, so the input is kept.
extern "C" const char* __asan_default_options() { return "abort_on_error=1:handle_abort=0"; }
extern "C" const char* __ubsan_default_options() {
  return "abort_on_error=1:print_stacktrace=1:handle_abort=0";
}

int main(int argc, char** argv) {
  std::signal(SIGABRT, onSignal);
  std::signal(SIGALRM, onSignal);
  if (argc == 2) {
    std::ifstream file(argv[1], std::ios::binary);
    run(Input(std::istreambuf_iterator<char>(file), {}));
    std::printf("%s: nothing found\n", argv[1]);
    return 0;
  }
  if (argc < 3) {
    std::fprintf(stderr, "use: %s FOLDER LENGTH [SEED], or %s FILE\n", argv[0], argv[0]);
    return 2;
  }
  const unsigned seed = argc > 3 ? unsigned(std::atoi(argv[3])) : 1;
  return fuzz(argv[1], Length(argv[2]), seed);
}
