#include "ground/report/core/account.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/text.hpp"
#include "ground/bounded_motion.hpp"

namespace gyre::ground {
namespace {

constexpr mechanics::CertifyOptions kFiguresOnly{false, false, false};

std::string file_name(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

std::string counted(std::uint64_t count, const char* noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::uint64_t count_in(const std::map<std::string, std::string>& words, const char* key) {
  const auto word = words.find(key);
  if (word == words.end() || word->second.find_first_not_of("0123456789") != std::string::npos) return 0;
  constexpr std::size_t kMostDigits = 18;
  return word->second.empty() || word->second.size() > kMostDigits ? 0 : std::stoull(word->second);
}

void add_file_remarks(const FileFacts& file, std::vector<std::string>& out) {
  if (!file.whole)
    out.emplace_back(
        "The file has no end: its recorder was stopped before it could write it, and the "
        "last moments of the flight may be missing.");
  for (const std::string& problem : file.problems) out.push_back("The file at " + problem + ".");
  if (file.problem_count > file.problems.size())
    out.push_back(counted(file.problem_count - file.problems.size(), "more place") + " of the file cannot be read.");
  const std::uint64_t lost = count_in(file.last_word, "lost");
  const std::uint64_t overrun = count_in(file.last_word, "lost_because_the_disk_was_slow");
  const std::uint64_t unwritten = count_in(file.last_word, "not_written");
  if (lost > 0) {
    out.push_back(counted(lost, "message") + " did not reach the recorder" +
                  (overrun > 0 ? ", " + std::to_string(overrun) + " of them because the disk was slow." : "."));
  }
  if (unwritten > 0)
    out.push_back(counted(unwritten, "message") + " could not be written, because the disk was full or failed.");
  if (file.undecodable > 0)
    out.push_back(counted(file.undecodable, "message") + " could not be read: not of this version, or damaged.");
}

/// Those that begin together, as when a recorder or a network stands still, are said together.
void add_silences(const FlightDigest& digest, std::vector<std::string>& out) {
  constexpr double kTogether_s = 0.1;
  std::vector<Silence> left = digest.silences();
  while (!left.empty()) {
    const Silence first = left.front();
    const auto together = [&first](const Silence& other) {
      return std::abs(other.begin_s - first.begin_s) < kTogether_s &&
             std::abs(other.duration_s - first.duration_s) < kTogether_s;
    };
    std::string who;
    for (const Silence& silence : left) {
      if (together(silence)) who += (who.empty() ? "" : ", ") + silence.who;
    }
    left.erase(std::remove_if(left.begin(), left.end(), together), left.end());
    out.push_back(text("The longest time that nothing was heard of %s is %.2f s, from %.2f s on.", who.c_str(),
                       first.duration_s, first.begin_s - digest.zero_s()));
  }
}

void add_flight_remarks(const Account& account, std::vector<std::string>& out) {
  const FlightDigest& digest = *account.digest;
  if (!digest.mission()) {
    out.emplace_back(
        "No mission's text is in the recording, so that nothing is certified here: give the mission that "
        "was flown with --mission FILE.");
  } else if (account.file.mission_given) {
    out.emplace_back("The mission was given for this report; the recording has no text of it.");
  }
  if (digest.mission() && !account.certified)
    out.emplace_back("The mission has no bounded motion, so that nothing is certified of it: gyre check says why.");
  if (digest.missions_told().size() > 1) {
    std::string names;
    for (const std::string& name : digest.missions_told()) names += (names.empty() ? "" : ", ") + name;
    out.push_back("The swarm went from mission to mission: " + names + ". Certified is the first.");
  }
  if (!digest.view().beacon()) out.emplace_back("No coordinator was heard: nobody knows when the motion was on.");
  if (digest.axis().leaps() > 0)
    out.push_back("Swarm time leapt " + counted(digest.axis().leaps(), "time") +
                  ", as when a swarm begins anew; the time axis goes on regardless.");
  if (digest.view().refused() > 0)
    out.push_back(counted(digest.view().refused(), "message") +
                  " not believed: nonsense, or of a second process in somebody's place.");
  add_silences(digest, out);
}

void judge(Account& account) {
  const FlightDigest& digest = *account.digest;
  if (account.certified) account.verdict = digest.judged();
  if (account.verdict) {
    account.standing = account.verdict->good() ? Standing::kInside : Standing::kOutside;
    account.standing_words = account.verdict->good() ? "inside its certificate" : "outside its certificate";
    return;
  }
  account.standing_words = !account.certified ? "not judged: nothing is certified"
                                              : "not judged: the motion at full pace is not in the recording";
}

}  // namespace

Account account(FileFacts file, std::unique_ptr<const FlightDigest> digest) {
  Account out;
  out.file = std::move(file);
  out.digest = std::move(digest);
  const auto& mission = out.digest->mission();
  out.name = mission ? mission->name : file_name(out.file.path);
  if (mission) {
    mechanics::Certificate certificate = mechanics::certify(mission->plan, kFiguresOnly);
    if (has_bounded_motion(certificate)) {
      Motion moves = motion(mission->plan, certificate);
      out.certified = Certified{std::move(certificate), std::move(moves)};
    }
  }
  judge(out);
  add_file_remarks(out.file, out.remarks);
  add_flight_remarks(out, out.remarks);
  return out;
}

void tell_apart(std::vector<Account>& accounts) {
  std::map<std::string, int> times;
  for (const Account& account : accounts) ++times[account.name];
  for (Account& account : accounts) {
    if (times[account.name] > 1) account.name += " (" + account.file.path + ")";
  }
}

}  // namespace gyre::ground
