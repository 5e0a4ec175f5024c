#include "common/program/journal.hpp"

#include <array>
#include <chrono>
#include <utility>

namespace gyre::program {
namespace {

/// What does not fill a piece waits no longer; and so often it is asked who listens, which costs more than to write.
constexpr Duration kPeriod = std::chrono::milliseconds(100);
/// A reader that is found here has perhaps not found this writer yet, and gets nothing that is said before; on a busy
/// machine for seconds. Who has it all passes over it.
constexpr std::array<Duration, 2> kBegins{std::chrono::seconds(1), std::chrono::seconds(4)};
/// Of what waits, so much goes at a beat: what has gathered until a recorder was found comes in some tenths of a
/// second, and does not drown what flies.
constexpr std::size_t kShare = 16;

}  // namespace

Journal::Journal(dds::Node& node, std::string process, const protocol::JournalEntry& beginning, std::size_t most_kept)
    : process_(std::move(process)),
      incarnation_(node.incarnation()),
      writer_(most_kept),
      pieces_(node.writer<protocol::JournalPiece>()) {
  writer_.add(beginning);
}

void Journal::send(LocalTime now) {
  const bool due = !looked_ || now < *looked_ || now - *looked_ >= kPeriod;  // a clock may be shifted back
  if (writer_.given_up() || (!due && readers_ == 0)) return;
  if (due) {
    looked_ = now;
    const int before = std::exchange(readers_, pieces_.readers());
    if (readers_ > before) came_ = now, begun_ = 0;
    if (readers_ == 0) return;
    if (begun_ < static_cast<int>(kBegins.size()) && now - *came_ >= kBegins[static_cast<std::size_t>(begun_)]) {
      ++begun_;
      writer_.begin_again();
    }
  }
  const std::size_t enough = writer_.waiting() - writer_.waiting() / kShare;
  do {
    auto piece = writer_.next(due);
    if (!piece) return;
    pieces_.write({process_, incarnation_, piece->offset, std::move(piece->bytes)});
  } while (writer_.waiting() > enough);
}

}  // namespace gyre::program
