#include "ground/whole_file.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace gyre::ground {
namespace {

namespace fs = std::filesystem;

bool written(const fs::path& file, const std::string& content) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << content;
  out.close();
  return out.good();
}

}  // namespace

std::optional<Error> write_whole(const std::string& path, const std::string& content) {
  const Error failed{path + ": cannot be written; name a file in a folder that is there and yours to write"};
  std::error_code problem;
  const fs::file_status there = fs::status(path, problem);
  if (fs::is_directory(there)) return Error{path + ": is a directory; name a file in it"};
  if (fs::exists(there) && !fs::is_regular_file(there))
    return written(path, content) ? std::nullopt : std::optional(failed);
  const fs::path target = fs::exists(there) ? fs::canonical(path, problem) : fs::path(path);
  const fs::path aside = target.string() + "." + std::to_string(::getpid()) + ".new";
  if (written(aside, content)) {
    fs::rename(aside, target, problem);
  } else {
    problem = std::make_error_code(std::errc::io_error);
  }
  if (!problem) return std::nullopt;
  std::error_code ignored;
  fs::remove(aside, ignored);
  return failed;
}

}  // namespace gyre::ground
