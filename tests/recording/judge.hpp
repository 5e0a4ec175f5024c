#pragma once
// Others' readers, by way of judge/run.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "tests/places.hpp"

namespace gyre::tests {

/// Runs a script of tests/recording/judge; false, and a word on standard output, where there is no Node, or no npm. A
/// script that complains fails the test.
inline bool judged(const std::string& script, const std::string& arguments) {
  const std::string command = test::source_directory() + "/tests/recording/judge/run " + test::program_directory() +
                              "/.. " + script + " " + arguments;
  const int status = std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe): nothing else starts programs here
  constexpr int kSkipped = 77;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kSkipped) return false;
  EXPECT_EQ(status, 0) << script << " complains, see above";
  return true;
}

}  // namespace gyre::tests
