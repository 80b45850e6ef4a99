// Reads which mutant is active, and writes which mutants each test reaches to the file PLUMB_REACH.
#include <gtest/gtest.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "switch.h"

namespace mutation {

unsigned alive = 0;
unsigned char reached[kMostMutants];
unsigned char kept[kMostMutants];

namespace {

// Runs before all constructors of global objects, which may already ask.
__attribute__((constructor(101))) void choose() {
  const char* chosen = getenv("PLUMB_MUTANT");
  if (chosen) alive = unsigned(atoi(chosen));
}

/// A line for each test: its name, its file, its time [ms], the mutants that it reached.
class Recorder : public testing::EmptyTestEventListener {
 public:
  explicit Recorder(const char* path) : file_(fopen(path, "w")) {}
  ~Recorder() override { fclose(file_); }

  void OnTestStart(const testing::TestInfo&) override { write("* *", 0); }
  void OnTestEnd(const testing::TestInfo& info) override {
    const std::string name =
        std::string(info.test_suite_name()) + "." + info.name() + " " + info.file();
    write(name.c_str(), info.result()->elapsed_time());
  }

 private:
  void write(const char* test, long long ms) {
    fprintf(file_, "%s %lld", test, ms);
    for (unsigned i = 0; i < kMostMutants; ++i)
      if (reached[i] || kept[i]) fprintf(file_, " %u", i);
    fputc('\n', file_);
    memset(reached, 0, sizeof(reached));
  }

  FILE* file_;
};

__attribute__((constructor)) void listen() {
  const char* path = getenv("PLUMB_REACH");
  if (path) testing::UnitTest::GetInstance()->listeners().Append(new Recorder(path));
}

}  // namespace
}  // namespace mutation
