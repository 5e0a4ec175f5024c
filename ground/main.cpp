// `gyre`: what a person on the ground types. This only dispatches; each family of commands has its folder.

#include "ground/check/check.hpp"
#include "ground/check/sample.hpp"
#include "ground/design/design.hpp"
#include "ground/flight/fly.hpp"
#include "ground/page/serve.hpp"
#include "ground/plot/plot.hpp"
#include "ground/recording/record.hpp"
#include "ground/replay/replay.hpp"
#include "ground/report/report.hpp"
#include "ground/swarm/health.hpp"
#include "ground/swarm/orders.hpp"
#include "ground/swarm/status.hpp"
#include "ground/swarm/watch.hpp"

int main(int argc, char** argv) {
  using namespace gyre::ground;
  return gyre::program::run(
      gyre::program::Family{
          "gyre",
          "Gyre: a load that hangs still while the vehicles that carry it never stop.",
          {check_command(), sample_command(), design_command(), plot_command(), fly_command(), engage_command(),
           release_command(), freeze_command(), pace_command(), retune_command(), status_command(), watch_command(),
           health_command(), serve_command(), record_command(), replay_command(), report_command()}},
      argc, argv);
}
