#pragma once
// What a program takes from its command line and its environment, as a table.
//
// A row is an option: its name, where its value goes, what it means. Every option has an environment variable of the
// same name, --log-level and GYRE_LOG_LEVEL, because containers and service units configure by those; the command line
// wins. Who reads a table need not know the library that parses it: that stands in command_line.cpp alone, because it
// costs every source that includes it seconds.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gyre::program {

/// What a program answers to the shell.
enum ExitCode {
  kGood = 0,
  kFailed = 1,    ///< a mission is refused, or something failed
  kBadUsage = 2,  ///< bad options or a bad file; nothing was started
};

/// Both ends are allowed; NaN is within no bounds.
struct Bounds {
  double least;
  double most;
};
inline constexpr Bounds kPositive{std::numeric_limits<double>::min(), std::numeric_limits<double>::max()};

/// Where an option's value goes; it has to live until the command has run. What stands there before is the default. A
/// vector takes the option any number of times, and from the environment words with commas between them; one that is
/// named by its place takes every word that is left.
using Target =
    std::variant<bool*, std::string*, std::optional<std::string>*, std::vector<std::string>*, int*, std::optional<int>*,
                 std::uint32_t*, std::uint64_t*, std::optional<std::uint64_t>*, double*, std::optional<double>*>;

/// How an option is taken, where not as usual.
enum class Take {
  kUsually,
  kRequired,
  kByHand,  ///< required, and from the command line only
};

struct Option {
  std::string name;  ///< "--domain", "-o,--output"; a name without dashes is a word by its place: "MISSION"
  Target value;
  std::string meaning;
  std::optional<Bounds> bounds{};  ///< of a number
  Take take = Take::kUsually;
};

struct OptionGroup {
  std::string title;
  std::vector<Option> options;
};

/// The group of what is a command's own.
[[nodiscard]] OptionGroup own(std::vector<Option> options);

struct Command {
  std::string name;  ///< of a program, "gyre-agent", or of what one program can do, "check"
  std::string purpose;
  std::vector<OptionGroup> groups;
  std::function<int()> run;  ///< with the values in place; returns the exit code
};

/// A program that does one thing. Help and complaints about the words are printed; returns the exit code.
[[nodiscard]] int run(const Command& command, int argc, const char* const* argv);

/// A program that does one thing out of several, chosen by the first word.
struct Family {
  std::string name;
  std::string purpose;
  std::vector<Command> commands;
};
[[nodiscard]] int run(const Family& family, int argc, const char* const* argv);

}  // namespace gyre::program
