#pragma once
// One recording as a report speaks of it: whose flight it is, what is certified of it, how it was judged, and what is
// missing in the file.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/mechanics/certificate.hpp"
#include "ground/flight/core/flight_report.hpp"
#include "ground/plot/core/motion.hpp"
#include "ground/report/core/flight_digest.hpp"

namespace gyre::ground {

/// What its reader found of the file.
struct FileFacts {
  std::string path;
  bool whole = false;                                   ///< its writer ended it
  std::vector<std::string> problems;                    ///< the first ones, in words
  std::uint64_t problem_count = 0;                      ///< of all
  std::map<std::string, std::string> begin, last_word;  ///< what its recorder says of itself; empty: it did not
  std::uint64_t messages = 0;                           ///< of a swarm
  std::uint64_t undecodable = 0;                        ///< said to be such, and are none
  bool mission_given = false;                           ///< by who asked for the report, not by the recording
};

enum class Standing { kInside, kOutside, kNotJudged };

/// What a plan's motion looks like, and what is certified of it.
struct Certified {
  mechanics::Certificate certificate;
  Motion motion;
};

struct Account {
  std::string name;  ///< of the mission; of the file where nobody knows the mission
  FileFacts file;
  std::unique_ptr<const FlightDigest> digest;
  std::optional<Certified> certified;   ///< absent without a mission whose motion has bounds
  std::optional<FlightReport> verdict;  ///< absent: not judged
  Standing standing = Standing::kNotJudged;
  std::string standing_words;
  std::vector<std::string> remarks;  ///< what was lost, is missing, or is not as one would expect
};

[[nodiscard]] Account account(FileFacts file, std::unique_ptr<const FlightDigest> digest);

/// Two flights of one mission are told apart by their files.
void tell_apart(std::vector<Account>& accounts);

}  // namespace gyre::ground
