#include "ground/report/recorded_flight.hpp"

#include <memory>
#include <utility>
#include <variant>

#include "ground/recording/message_stream.hpp"

namespace gyre::ground {
namespace {

/// The first that the swarm told. The digest has to know it from the first message on, and it may come late.
std::optional<mission::Mission> told_mission(const McapSource& source) {
  using Missions = MessageStream<std::variant<protocol::MissionText>>;
  auto opened = Missions::open(source);
  if (!opened) return std::nullopt;
  Missions missions = std::move(opened).value();
  while (const auto told = missions.next()) {
    const std::string& text = std::get<protocol::MissionText>(told->message).text;
    if (text.empty()) continue;
    auto mission = mission::parse_mission(text, "the recording's mission");
    if (mission) return std::move(mission).value();
  }
  return std::nullopt;
}

void learn_of_file(const McapStream& stream, FileFacts& file) {
  file.whole = stream.whole();
  for (const McapProblem& problem : stream.problems().first()) file.problems.push_back(told(problem));
  file.problem_count = stream.problems().count();
  for (const Metadata& metadata : stream.directory().metadata()) {
    if (metadata.name == "gyre") file.begin = metadata.entries;
    if (metadata.name == "gyre_recording") file.last_word = metadata.entries;
  }
}

}  // namespace

Result<Account> read_flight(const std::string& path, const McapSource& source,
                            const std::optional<mission::Mission>& given) {
  auto opened = SwarmStream::open(source);
  if (!opened) return Error{path + ": " + opened.error().text};
  SwarmStream stream = std::move(opened).value();
  auto mission = told_mission(source);
  FileFacts file;
  file.path = path;
  file.mission_given = !mission && given;
  if (!mission) mission = given;
  auto digest = std::make_unique<FlightDigest>(std::move(mission));
  while (const auto heard = stream.next()) {
    ++file.messages;
    digest->see(heard->arrived, heard->message);
  }
  file.undecodable = stream.undecodable();
  learn_of_file(stream.file(), file);
  if (file.messages == 0) {
    return Error{path + ": nothing of a swarm is recorded in it" +
                 (file.undecodable > 0 ? ", or it was recorded by another version of gyre" : "") +
                 "; name a file that gyre record has written while a swarm flew"};
  }
  return account(std::move(file), std::move(digest));
}

}  // namespace gyre::ground
