#include "common/base/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <array>
#include <memory>
#include <utility>

namespace gyre {

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
    spdlog::set_default_logger(std::move(logger));
    return level;
  }
  return Error{"log level \"" + level + "\" does not exist: trace, debug, info, warning, error or off"};
}

void log(const Notices& notices) {
  for (const Notice& notice : notices) {
    switch (notice.level) {
      case Notice::Level::kInfo:
        spdlog::info("{}", notice.text);
        break;
      case Notice::Level::kWarning:
        spdlog::warn("{}", notice.text);
        break;
      case Notice::Level::kError:
        spdlog::error("{}", notice.text);
        break;
    }
  }
}

}  // namespace gyre
