#pragma once
// Runs the `gyre` program as a shell would, bounded in time.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/places.hpp"

namespace gyre::test {

struct Answer {
  int exit_code = -1;
  std::string output;
  std::string complaint;  ///< what went to standard error
};

/// `arguments` as the shell reads them.
inline Answer gyre(const std::string& arguments) {
  const std::string complaint_file = ::testing::TempDir() + "gyre-complaint-" + std::to_string(::getpid());
  const std::string command =
      "timeout 60 '" + program_directory() + "/gyre' " + arguments + " 2>'" + complaint_file + "'";
  Answer answer;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return answer;
  std::array<char, 65536> buffer{};
  for (std::size_t got = 0; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    answer.output.append(buffer.data(), got);
  }
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) answer.exit_code = WEXITSTATUS(status);
  std::ostringstream complaint;
  complaint << std::ifstream(complaint_file).rdbuf();
  answer.complaint = complaint.str();
  std::filesystem::remove(complaint_file);
  return answer;
}

inline std::string shipped(const std::string& mission) {
  return "'" + source_directory() + "/deploy/missions/" + mission + ".textproto'";
}

}  // namespace gyre::test
