#include "ground/page/stage.hpp"

#include <algorithm>

namespace gyre::ground {
namespace {

std::string event(const char* name, const std::string& json) {
  return std::string("event: ") + name + "\ndata: " + json + "\n\n";
}

const char* name(Scene scene) {
  switch (scene) {
    case Scene::kHello:
      return "hello";
    case Scene::kMission:
      return "mission";
    case Scene::kStatus:
      return "status";
    case Scene::kFrame:
      return "frame";
  }
  return "unknown";
}

}  // namespace

void Stage::show(Scene scene, const std::string& json) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    Event& shown = scenes_[static_cast<std::size_t>(scene)];
    shown.text = event(name(scene), json);
    ++shown.version;
  }
  changed_.notify_all();
}

void Stage::happen(const std::string& json) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    happenings_.push_back(event("happening", json));
    ++happened_;
    if (happenings_.size() > kKept) happenings_.pop_front();
  }
  changed_.notify_all();
}

bool Stage::has_news(const Cursor& cursor) const {
  if (cursor.happenings < happened_) return true;
  for (std::size_t i = 0; i < kScenes; ++i) {
    if (cursor.seen[i] < scenes_[i].version) return true;
  }
  return false;
}

std::optional<std::string> Stage::next(Cursor& cursor, Duration patience) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, patience, [&] { return closed_ || has_news(cursor); });
  if (closed_) return std::nullopt;
  std::string text;
  for (std::size_t i = 0; i < kScenes; ++i) {
    if (cursor.seen[i] == scenes_[i].version) continue;
    text += scenes_[i].text;
    cursor.seen[i] = scenes_[i].version;
  }
  const std::uint64_t forgotten = happened_ - happenings_.size();
  for (std::uint64_t n = std::max(cursor.happenings, forgotten); n < happened_; ++n) text += happenings_[n - forgotten];
  cursor.happenings = happened_;
  return text;
}

void Stage::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

int Stage::watchers() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return watchers_;
}

bool Stage::enter(int most) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (watchers_ >= most) return false;
  ++watchers_;
  return true;
}

void Stage::leave() {
  const std::lock_guard<std::mutex> lock(mutex_);
  --watchers_;
}

}  // namespace gyre::ground
