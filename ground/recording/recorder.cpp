#include "ground/recording/recorder.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

#include "common/base/log.hpp"
#include "common/base/version.hpp"
#include "common/dds/clock.hpp"

namespace gyre::ground {
namespace {

constexpr std::uint64_t kMostQueued = std::uint64_t{64} << 20;
constexpr std::uint64_t kScene_ns = 40'000'000;
constexpr std::uint64_t kOrbits_ns = 1'000'000'000;
constexpr auto kBeat = std::chrono::milliseconds(50);

std::uint64_t memory_of(const dds::RecordedSample& sample) {
  constexpr std::uint64_t kAround = 64;  // what the heap takes for itself
  return sizeof(sample) + sample.payload.size() + kAround;
}

}  // namespace

Recorder::Recorder(RecordingFile file, const RecordingBegin& begin, std::map<std::string, std::string> about,
                   std::optional<mission::Mission> mission)
    : file_(std::move(file)),
      begin_(begin),
      recording_(version(), std::move(about)),
      mission_(std::move(mission)),
      thread_([this] { run(); }) {}

Recorder::~Recorder() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void Recorder::push(dds::RecordedSample sample) {
  const std::uint64_t bytes = memory_of(sample);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (queued_bytes_ + bytes > kMostQueued) {
      ++overrun_;
      return;
    }
    queued_bytes_ += bytes;
    queue_.push_back(std::move(sample));
  }
  // The writer looks by itself, twenty times a second: to wake it for every message costs more than to write it.
}

std::set<CarrierId> Recorder::carriers() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return carriers_;
}

std::uint64_t Recorder::log_ns(LocalTime time) const {
  return begin_.wall_ns + static_cast<std::uint64_t>(std::max(Duration::zero(), time - begin_.local).count());
}

void Recorder::run() {
  unwritten_beginning_ = !write(recording_.begin());
  std::deque<dds::RecordedSample> taken;
  for (bool last = false; !last;) {
    taken.clear();
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait_for(lock, kBeat, [this] { return over_; });
      last = over_ && queue_.empty();
      taken.swap(queue_);
      troubles_.overrun = overrun_;
    }
    for (dds::RecordedSample& sample : taken) {
      const std::uint64_t bytes = memory_of(sample);
      take(std::move(sample));
      // Room is given back as it is made: the queue and what was taken from it are one memory.
      const std::lock_guard<std::mutex> lock(mutex_);
      queued_bytes_ -= bytes;
    }
    if (recording_.writer().due(log_ns(dds::now()))) write_chunk();
  }
}

void Recorder::take(dds::RecordedSample sample) {
  look(sample);
  const std::uint64_t now_ns = log_ns(sample.arrived);
  const bool retained = sample.topic->delivery == dds::Delivery::kRetained;
  recording_.add({sample.topic->name,
                  sample.topic->type,
                  {dds::reliable(sample.topic->delivery), retained},
                  sample.writer,
                  sample.sequence,
                  sample.source_ns,
                  now_ns,
                  std::move(sample.payload)});
  if (now_ns >= next_scene_ns_) show(now_ns);
  if (recording_.writer().due(now_ns)) write_chunk();
}

void Recorder::look(const dds::RecordedSample& sample) {
  const auto [known, added] = decoders_.emplace(sample.topic, nullptr);
  if (added) {
    if (const auto type = type_of_wire_name(sample.topic->type))
      known->second = MessageDecoders<SceneMessage>::find(*type);
  }
  if (known->second == nullptr) return;
  auto message = known->second(sample.payload);
  if (!message) return;
  std::visit([&](auto& told) { view_.step(sample.arrived, std::move(told)); }, *message);
  if (std::holds_alternative<protocol::HeldPlans>(*message)) next_orbits_ns_ = 0;
  if (std::holds_alternative<protocol::CoordinatorStatus>(*message) && view_.coordinator()) {
    const std::lock_guard<std::mutex> lock(mutex_);
    carriers_.insert(view_.coordinator()->carriers.begin(), view_.coordinator()->carriers.end());
  }
  if (std::holds_alternative<protocol::MissionText>(*message)) learn_mission();
}

void Recorder::learn_mission() {
  if (!view_.mission() || view_.mission()->text == mission_text_) return;
  mission_text_ = view_.mission()->text;
  if (auto told = mission::parse_mission(mission_text_, "the mission in force")) mission_ = std::move(told).value();
}

void Recorder::show(std::uint64_t now_ns) {
  next_scene_ns_ = std::max(next_scene_ns_ + kScene_ns, now_ns);  // a pause is not made up for
  recording_.add(scene(view_, mission_ ? &*mission_ : nullptr), now_ns);
  if (now_ns < next_orbits_ns_) return;
  next_orbits_ns_ = now_ns + kOrbits_ns;
  recording_.add_orbits(planned_orbits(view_), now_ns);
}

bool Recorder::write(const Bytes& piece) {
  const auto failed = file_.append(piece);
  if (failed && !disk_complained_) {
    log_error(failed->text +
              ". The recording goes on when it can be written again; until then messages are lost to it");
  }
  if (!failed && disk_complained_) log_info(file_.path() + ": it can be written again, the recording goes on");
  disk_complained_ = failed.has_value();
  if (failed) {
    recording_.writer().discarded();
  } else {
    recording_.writer().written();
  }
  return !failed;
}

void Recorder::write_chunk() {
  const std::uint64_t messages = recording_.writer().open_messages();
  if (unwritten_beginning_) unwritten_beginning_ = !write(recording_.begin());
  const Bytes piece = recording_.writer().close_chunk();
  if (unwritten_beginning_) {
    recording_.writer().discarded();  // nothing can stand in front of a file's beginning
  } else if (piece.empty() || write(piece)) {
    return;
  }
  troubles_.unwritten += messages;
  ++troubles_.chunks;
}

Recorder::End Recorder::finish() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  thread_.join();
  write_chunk();
  bool ended = false;
  if (!unwritten_beginning_) ended = write(recording_.writer().finish(recording_.last_word(troubles_)));
  End end;
  end.table = recording_table(recording_.counts());
  end.line = recording_line(recording_, recording_.writer().statistics(), file_.size(), troubles_);
  if (!ended) end.line += "; the file has no summary, and reads from its front only";
  end.complete = ended && troubles_.unwritten == 0 && troubles_.overrun == 0;
  return end;
}

}  // namespace gyre::ground
