#include "common/base/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cstdio>
#include <memory>
#include <utility>

namespace gyre {
namespace {

/// Null until the log is started; read by the main thread only.
std::shared_ptr<spdlog::logger> the_log;  // NOLINT(readability-identifier-naming)

spdlog::level::level_enum level_of(Notice::Level level) {
  switch (level) {
    case Notice::Level::kInfo:
      return spdlog::level::info;
    case Notice::Level::kWarning:
      return spdlog::level::warn;
    case Notice::Level::kError:
      return spdlog::level::err;
  }
  return spdlog::level::err;
}

}  // namespace

Result<std::string> start_log(const std::string& process_name, const std::string& level) {
  constexpr std::array<std::pair<const char*, spdlog::level::level_enum>, 6> kLevels = {{
      {"trace", spdlog::level::trace},
      {"debug", spdlog::level::debug},
      {"info", spdlog::level::info},
      {"warning", spdlog::level::warn},
      {"error", spdlog::level::err},
      {"off", spdlog::level::off},
  }};
  for (const auto& [word, value] : kLevels) {
    if (level != word) continue;
    auto sink = std::make_shared<spdlog::sinks::stdout_color_sink_mt>();
    auto logger = std::make_shared<spdlog::logger>(process_name, std::move(sink));
    logger->set_pattern("[%H:%M:%S.%e] [%n] [%^%l%$] %v");
    logger->set_level(value);
    logger->flush_on(spdlog::level::trace);
    the_log = std::move(logger);
    return level;
  }
  return Error{"log level \"" + level + "\" does not exist: trace, debug, info, warning, error or off"};
}

void log(Notice::Level level, const std::string& text) {
  if (the_log == nullptr) {
    std::fprintf(stderr, "%s\n", text.c_str());
  } else {
    the_log->log(level_of(level), text);
  }
}

void log(const Notices& notices) {
  for (const Notice& notice : notices) log(notice.level, notice.text);
}

}  // namespace gyre
