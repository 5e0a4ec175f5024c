#include "common/program/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cctype>
#include <cstdio>
#include <type_traits>

#include "common/base/text.hpp"

namespace gyre::program {
namespace {

constexpr const char* kOwnGroup = "Options";
constexpr const char* kExitCodes = "Exit codes: 0 good, 1 refused or failed, 2 bad usage or bad file.";

/// "--log-level" -> "GYRE_LOG_LEVEL", "-o,--output" -> "GYRE_OUTPUT"
std::string variable_of(const std::string& names) {
  const std::string name = names.substr(names.rfind(',') + 1);
  std::string variable = "GYRE_";
  for (const char c : name.substr(name.find_first_not_of('-'))) {
    variable += c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return variable;
}

/// CLI::Range would let NaN through.
CLI::Validator within(const Bounds& bounds) {
  const auto judge = [bounds](const std::string& words) {
    double value = 0.0;
    const bool good = CLI::detail::lexical_cast(words, value) && value >= bounds.least && value <= bounds.most;
    if (good) return std::string();
    if (bounds.least == kPositive.least) return words + " is no positive number";
    return words + text(" is no number from %.9g to %.9g", bounds.least, bounds.most);
  };
  return {judge, ""};
}

/// From the environment an empty word is as good as none, and does not come here.
CLI::Validator not_empty() {
  const auto judge = [](const std::string& words) {
    return words.empty() ? std::string("an empty word says nothing; give it a value, or leave it out") : std::string();
  };
  return {judge, ""};
}

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

template <class T>
CLI::Option* declare(CLI::App& app, const Option& option, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return app.add_flag(option.name, value, option.meaning);
  } else {
    CLI::Option* const declared = app.add_option(option.name, value, option.meaning);
    if constexpr (std::is_same_v<T, std::vector<std::string>>) {
      if (option.name.front() == '-') {
        declared->delimiter(',')->expected(1)->take_all();
      } else {
        declared->expected(1, CLI::detail::expected_max_vector_size);  // the shell has parted them
      }
    } else if constexpr (!IsOptional<T>::value) {
      if (option.take == Take::kUsually) declared->capture_default_str();
    }
    return declared;
  }
}

void declare(CLI::App& app, const std::vector<OptionGroup>& groups) {
  app.footer(kExitCodes);
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      CLI::Option* const declared = std::visit([&](auto* value) { return declare(app, option, *value); }, option.value);
      if (option.name.front() == '-') declared->group(group.title);
      if (!std::holds_alternative<bool*>(option.value)) declared->check(not_empty());
      if (option.bounds) declared->check(within(*option.bounds));
      if (option.take != Take::kUsually) declared->required();
      if (option.take != Take::kByHand) declared->envname(variable_of(option.name));
    }
  }
}

/// Absent: go on. Otherwise what to exit with: help was asked for, or the words are wrong, and that was said.
std::optional<int> parse(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem);  // --help
    std::fprintf(stderr, "%s: %s\nSee `%s --help`.\n", app.get_name().c_str(), problem.what(), app.get_name().c_str());
    return kBadUsage;
  }
  return std::nullopt;
}

}  // namespace

OptionGroup own(std::vector<Option> options) {
  return {kOwnGroup, std::move(options)};
}

int run(const Command& command, int argc, const char* const* argv) {
  CLI::App app{command.purpose, command.name};
  declare(app, command.groups);
  if (const auto answer = parse(app, argc, argv)) return *answer;
  return command.run();
}

int run(const Family& family, int argc, const char* const* argv) {
  CLI::App app{family.purpose, family.name};
  declare(app, {});
  app.require_subcommand(0, 1);  // none is answered below: CLI11 would not say which word it did not know
  for (const Command& command : family.commands)
    declare(*app.add_subcommand(command.name, command.purpose), command.groups);
  if (const auto answer = parse(app, argc, argv)) return *answer;
  for (const Command& command : family.commands) {
    if (app.got_subcommand(command.name)) return command.run();
  }
  std::fputs(app.help().c_str(), stderr);
  return kBadUsage;
}

}  // namespace gyre::program
