#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "common/mission/mission.hpp"
#include "common/mission/requirements.hpp"

namespace gyre::mission {
namespace {

Result<std::string> read_text(const std::string& path) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  if (!std::filesystem::exists(status)) {
    return Error{path + ": no such file; give the path of a mission, as deploy/missions has"};
  }
  if (std::filesystem::is_directory(status)) {
    return Error{path + ": is a directory; give the path of one mission file inside it"};
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{path + ": cannot be opened: " + std::strerror(errno)};
  // One byte more than allowed is enough to know: an endless device must not fill the memory.
  std::string text(kMaxMissionBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) return Error{path + ": cannot be read: " + std::strerror(errno)};
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace

Result<Mission> read_mission_file(const std::string& path) {
  const Result<std::string> text = read_text(path);
  if (!text) return text.error();
  return parse_mission(text.value(), path);
}

Result<Requirements> read_requirements_file(const std::string& path) {
  const Result<std::string> text = read_text(path);
  if (!text) return text.error();
  return parse_requirements(text.value(), path);
}

}  // namespace gyre::mission
