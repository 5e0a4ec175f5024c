#include "ground/page/serve.hpp"

#include <cstdio>
#include <memory>

#include "common/base/interrupts.hpp"
#include "common/base/log.hpp"
#include "common/dds/health_reporter.hpp"
#include "common/program/program.hpp"
#include "ground/page/page.hpp"
#include "ground/swarm/core/swarm_complaint.hpp"
#include "ground/swarm/ground_seat.hpp"
#include "ground/swarm/listening.hpp"

namespace gyre::ground {
namespace {

struct ServeOptions {
  PageOptions page;
  program::Options common;
};

int serve(const ServeOptions& options) {
  block_interrupts();
  if (const auto why = objection(options.page)) {
    log_error(*why);
    return program::kBadUsage;
  }
  if (const auto answer = program::start("gyre serve", options.common)) return *answer;
  const auto opened = program::open_node(options.common.network, ground_seat(options.common.network));
  if (!opened) return opened.error();
  dds::Node& node = *opened.value();
  SwarmView view;
  PageOwner owner;
  owner.domain = node.domain();
  const auto page = Page::open(options.page, owner, &node, view);
  if (!page) {
    log_error(page.error().text);
    return program::kFailed;
  }
  Listening listening(node, Interest::kCarriers);
  dds::HealthReporter health(node, "ground");
  std::printf("The page of domain %d: %s\n", node.domain(), page.value()->url().c_str());
  std::fflush(stdout);

  LocalTime next = dds::now();
  while (take_interrupts().total() == 0) {
    next += PageFeed::kFrame;
    if (next < dds::now()) next = dds::now() + PageFeed::kFrame;  // a stall is not made up for
    for (const Heard& heard : listening.sleep_until(next)) {
      if (view.step(heard.arrived, heard.message)) page.value()->hear(heard.arrived, heard.message);
    }
    listening.attend(view.carrier_ids());
    const LocalTime now = dds::now();
    page.value()->step(now);
    health.step(now, out_of_contact(view, now), {}, listening.dropped(), listening.late());
  }
  return program::kGood;
}

}  // namespace

program::Command serve_command() {
  const auto options = std::make_shared<ServeOptions>();
  return {"serve", "Serve the page of a swarm that flies: its scene, its figures, orders to it.",
          program::with_common(page_options(options->page), options->common), [options] { return serve(*options); }};
}

}  // namespace gyre::ground
