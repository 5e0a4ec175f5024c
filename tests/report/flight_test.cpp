// A flight told message by message: what is kept of it, how it is judged, and what is drawn and said.

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "ground/report/core/account.hpp"
#include "ground/report/core/flown_charts.hpp"
#include "ground/report/core/flown_paths.hpp"
#include "ground/report/core/page.hpp"
#include "ground/report/core/sheets.hpp"
#include "tests/ground/svg_reader.hpp"
#include "tests/places.hpp"
#include "tests/report/perfect_swarm.hpp"

namespace gyre::ground {
namespace {

using test::PerfectSwarm;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

std::unique_ptr<const FlightDigest> digested(const PerfectSwarm& swarm) {
  auto digest = std::make_unique<FlightDigest>(swarm.tells_mission ? std::optional(swarm.mission) : std::nullopt);
  for (const Heard& heard : swarm.flight()) digest->see(heard.arrived, heard.message);
  return digest;
}

FileFacts whole_file(const std::string& path = "folder/a.mcap") {
  FileFacts file;
  file.path = path;
  file.whole = true;
  return file;
}

Account account_of(const PerfectSwarm& swarm, FileFacts file = whole_file()) {
  return account(std::move(file), digested(swarm));
}

std::vector<Account> both() {
  std::vector<Account> accounts;
  accounts.push_back(account_of(PerfectSwarm(test::shipped_mission("paper"))));
  accounts.push_back(account_of(PerfectSwarm(test::shipped_mission("paper-fixed")), whole_file("folder/b.mcap")));
  return accounts;
}

/// What a browser reads as HTML and our reader as XML; the first line is HTML's alone.
test::SvgFile read_page(const std::string& page) {
  const std::string doctype = "<!DOCTYPE html>\n";
  EXPECT_EQ(page.rfind(doctype, 0), 0U);
  return test::read_svg(page.substr(doctype.size()));
}

TEST(ReportFlight, ItsExtremesAreThoseThatWereTold) {
  const PerfectSwarm swarm(test::shipped_mission("paper-fixed"));
  const auto digest = digested(swarm);
  ASSERT_EQ(digest->carriers().size(), 4U);
  std::map<CarrierId, mechanics::Range> tension_n, altitude_m, speed_m_s;
  for (const Heard& heard : swarm.flight()) {
    const auto* state = std::get_if<protocol::CarrierState>(&heard.message);
    if (!state) continue;
    tension_n[state->carrier].include(state->tension_n);
    altitude_m[state->carrier].include(state->position_w_m.z());
    speed_m_s[state->carrier].include(state->velocity_w_m_s.norm());
  }
  const auto same = [](const Envelope& envelope, const mechanics::Range& told) {
    EXPECT_EQ(envelope.figures().min, told.min);
    EXPECT_EQ(envelope.figures().max, told.max);
  };
  for (const auto& [id, series] : digest->carriers()) {
    same(series.tension_n, tension_n[id]);
    same(series.altitude_m, altitude_m[id]);
    same(series.speed_m_s, speed_m_s[id]);
  }
  EXPECT_NEAR(digest->load().displacement_mm.figures().max, 0.01, 1e-4);
}

TEST(ReportFlight, FullPaceIsFoundAndMarked) {
  const auto digest = digested(PerfectSwarm(test::shipped_mission("paper")));
  ASSERT_EQ(digest->motion_s().size(), 1U);
  EXPECT_NEAR(digest->motion_s()[0].min, PerfectSwarm::kEngage_s + PerfectSwarm::kRamp_s, 2 * PerfectSwarm::kBeat_s);
  EXPECT_NEAR(digest->motion_s()[0].max, PerfectSwarm::kRelease_s, 2 * PerfectSwarm::kBeat_s);
  EXPECT_NEAR(digest->flown_s(), 85.0, 3 * PerfectSwarm::kBeat_s);
}

TEST(ReportFlight, APerfectOneIsInsideItsCertificate) {
  for (const char* name : {"paper", "paper-fixed"}) {
    const Account account = account_of(PerfectSwarm(test::shipped_mission(name)));
    EXPECT_EQ(account.standing, Standing::kInside) << account.standing_words;
    EXPECT_EQ(account.name, name);
    EXPECT_THAT(account.remarks, IsEmpty());
    ASSERT_TRUE(account.verdict);
    EXPECT_EQ(account.verdict->carriers.size(), 4U);
  }
}

TEST(ReportFlight, OneMomentOutsideIsFoundDrawnAndSaid) {
  PerfectSwarm swarm(test::shipped_mission("paper"));
  swarm.spoil = [](double t_s, protocol::CarrierState& state) {
    if (state.carrier == 2 && std::abs(t_s - 50.0) < 0.01) state.tension_n = 3.25;
  };
  std::vector<Account> accounts;
  accounts.push_back(account_of(swarm));
  EXPECT_EQ(accounts[0].standing, Standing::kOutside);
  ASSERT_TRUE(accounts[0].verdict);
  EXPECT_THAT(accounts[0].verdict->violations, Contains(HasSubstr("carrier 2: tension 3.25 N")));
  const Chart chart = flown_chart(Quantity::kTension, accounts[0], places(accounts), 300.0);
  mechanics::Range drawn;
  for (const auto& piece : chart.lines[1].pieces) {
    for (const Point& point : piece) drawn.include(point.y);
  }
  EXPECT_EQ(drawn.max, 3.25);
  const std::string page = report_page(accounts, sheets(accounts));
  EXPECT_THAT(page, HasSubstr("outside its certificate"));
  EXPECT_THAT(page, HasSubstr("carrier 2: tension 3.25 N"));
  EXPECT_THAT(report_text(accounts), HasSubstr("OUTSIDE its certificate"));
}

TEST(ReportFlight, WithoutAMissionWhatWasFlownIsShownAndNothingJudged) {
  PerfectSwarm swarm(test::shipped_mission("paper"));
  swarm.tells_mission = false;
  std::vector<Account> accounts;
  accounts.push_back(account_of(swarm));
  EXPECT_EQ(accounts[0].standing, Standing::kNotJudged);
  EXPECT_EQ(accounts[0].name, "a.mcap");
  EXPECT_THAT(accounts[0].remarks, Contains(HasSubstr("--mission FILE")));
  const std::vector<Sheet> drawn = sheets(accounts);
  for (const Sheet& sheet : drawn) {
    EXPECT_EQ(test::read_svg(sheet.svg).complaint, "") << sheet.name;
    EXPECT_EQ(sheet.svg.find("certified 0"), std::string::npos) << sheet.name;
  }
  EXPECT_EQ(read_page(report_page(accounts, drawn)).complaint, "");
}

TEST(ReportFlight, OneThatNeverReachesFullPaceIsNotJudged) {
  const PerfectSwarm swarm(test::shipped_mission("paper"));
  auto digest = std::make_unique<FlightDigest>(swarm.mission);
  for (const Heard& heard : swarm.flight()) {
    if (heard.arrived < LocalTime(from_seconds(1e6 + 12.0))) digest->see(heard.arrived, heard.message);
  }
  const Account resting = account(whole_file(), std::move(digest));
  EXPECT_EQ(resting.standing, Standing::kNotJudged);
  EXPECT_THAT(resting.standing_words, HasSubstr("full pace"));
}

TEST(ReportFlight, SilencesAndWhatIsWrongWithTheFileAreSaid) {
  PerfectSwarm swarm(test::shipped_mission("paper"));
  swarm.spoil = [](double t_s, protocol::CarrierState& state) {
    if ((state.carrier == 3 && t_s > 40.0 && t_s < 42.0) || (state.carrier == 1 && t_s > 90.05)) state.carrier = 0;
  };
  FileFacts file = whole_file();
  file.whole = false;
  file.problems = {"byte 77: the file was cut off here"};
  file.problem_count = 3;
  file.last_word = {{"lost", "12"}, {"lost_because_the_disk_was_slow", "5"}, {"not_written", "what?"}};
  file.undecodable = 1;
  const Account account = account_of(swarm, file);
  for (const char* words :
       {"of carrier 3 is 2.00 s, from 25.", "of carrier 1 is 24.9", "The file has no end", "byte 77", "2 more places",
        "12 messages did not reach the recorder, 5 of them", "1 message could not be read"}) {
    EXPECT_THAT(account.remarks, Contains(HasSubstr(words)));
  }
  EXPECT_EQ(account.remarks.size(), 7U) << "what is no number is no count";
  const Places all{{1, 0}, {2, 1}, {3, 2}, {4, 3}};
  const Chart chart = flown_chart(Quantity::kSpeed, account, all, 300.0);
  EXPECT_EQ(chart.lines[2].pieces.size(), 2U) << "no line is drawn where nothing was heard";
}

TEST(ReportFlight, TwoStandBesideEachOtherInOneScale) {
  const std::vector<Account> accounts = both();
  for (const Quantity quantity : {Quantity::kAltitude, Quantity::kSpeed, Quantity::kLength, Quantity::kWinchRate,
                                  Quantity::kTension, Quantity::kDisplacement, Quantity::kRotation}) {
    std::vector<Chart> charts;
    for (const Account& account : accounts) charts.push_back(flown_chart(quantity, account, places(accounts), 300.0));
    bring_to_one_scale(charts);
    EXPECT_EQ(chart_shows(charts[0]).min, chart_shows(charts[1]).min);
    EXPECT_EQ(chart_shows(charts[0]).max, chart_shows(charts[1]).max);
    EXPECT_EQ(charts[0].time_s.min, charts[1].time_s.min);
    EXPECT_EQ(charts[0].time_s.max, charts[1].time_s.max);
  }
}

TEST(ReportFlight, ThoseThatDifferMuchInSizeHaveScalesOfTheirOwn) {
  std::vector<Account> accounts = both();
  EXPECT_TRUE(of_one_size(accounts));
  EXPECT_THAT(sheets(accounts)[0].caption, HasSubstr("in one scale"));
  accounts.push_back(account_of(PerfectSwarm(test::shipped_mission("fixed-wing-trio"))));
  EXPECT_FALSE(of_one_size(accounts));
  EXPECT_THAT(sheets(accounts)[1].caption, HasSubstr("a scale of its own"));
}

TEST(ReportFlight, ThePapersComparisonIsInThePicture) {
  const std::vector<Account> accounts = both();
  const Places all = places(accounts);
  const Chart level = flown_chart(Quantity::kAltitude, accounts[0], all, 300.0);
  const Chart fixed = flown_chart(Quantity::kAltitude, accounts[1], all, 300.0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(level.lines[i].flown->span(), 1e-9) << "level carriers stay at their altitude";
    EXPECT_GT(fixed.lines[i].flown->span(), 0.5) << "on cables of fixed length they swing by decimetres";
    EXPECT_NEAR(fixed.lines[i].flown->span(), fixed.lines[i].certified->span(), 1e-3);
  }
}

TEST(ReportFlight, SheetsAndPageAreWellFormedAndStandAlone) {
  const std::vector<Account> accounts = both();
  const std::vector<Sheet> drawn = sheets(accounts);
  ASSERT_EQ(drawn.size(), 4U);
  for (const Sheet& sheet : drawn) {
    const test::SvgFile picture = test::read_svg(sheet.svg);
    EXPECT_EQ(picture.complaint, "") << sheet.name;
    EXPECT_TRUE(picture.says("paper-fixed")) << sheet.name;
    EXPECT_LT(sheet.svg.size(), 200'000U) << sheet.name;
    for (const test::Element& line : picture.all("polyline"))
      EXPECT_EQ(line.attributes.at("points").find("nan"), std::string::npos);
  }
  const std::string page = report_page(accounts, drawn);
  const test::SvgFile read = read_page(page);
  EXPECT_EQ(read.complaint, "");
  EXPECT_EQ(read.all("svg").size(), 4U);
  EXPECT_EQ(read.all("table").size(), 2U);
  for (const char* outside : {"script", "link", "img", "iframe", "object"}) EXPECT_THAT(read.all(outside), IsEmpty());
  EXPECT_EQ(page.find("url("), std::string::npos);
  EXPECT_THAT(page, HasSubstr("@media print"));
  EXPECT_THAT(page, HasSubstr("prefers-color-scheme:dark"));
  EXPECT_TRUE(is_report_page(page.substr(0, kPageBeginning)));
  EXPECT_FALSE(is_report_page("<!DOCTYPE html>\n<html><head><title>mine</title></head>"));
}

TEST(ReportFlight, OfNearlyNothingThereIsAReportToo) {
  PerfectSwarm swarm(test::shipped_mission("paper"));
  for (const bool known : {true, false}) {
    for (const bool carriers : {true, false}) {
      PerfectSwarm little = swarm;
      little.tells_mission = known;
      if (!carriers) little.slices.clear();
      const std::vector<Heard> all = little.flight();
      for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{4}, std::size_t{9}, all.size()}) {
        auto digest = std::make_unique<FlightDigest>(known ? std::optional(little.mission) : std::nullopt);
        for (std::size_t k = 0; k < count; ++k) digest->see(all[k].arrived, all[k].message);
        std::vector<Account> accounts;
        accounts.push_back(account(whole_file(), std::move(digest)));
        EXPECT_TRUE(carriers || accounts[0].standing != Standing::kInside);
        const std::vector<Sheet> drawn = sheets(accounts);
        for (const Sheet& sheet : drawn) {
          EXPECT_EQ(test::read_svg(sheet.svg).complaint, "");
          for (const char* nonsense : {"nan", "inf,", "inf ", "inf\""})
            EXPECT_EQ(sheet.svg.find(nonsense), std::string::npos) << sheet.name << " has " << nonsense;
        }
        EXPECT_EQ(read_page(report_page(accounts, drawn)).complaint, "");
      }
    }
  }
}

/// They are of recorded flights, so their lines are not today's; what stands around these is.
TEST(ReportFlight, TheCommittedPicturesSayWhatTheCommandSaysToday) {
  for (const Sheet& sheet : sheets(both())) {
    if (sheet.name != "motion" && sheet.name != "load") continue;
    std::ostringstream text;
    text << std::ifstream(test::source_directory() + "/docs/pictures/report-" + sheet.name + ".svg").rdbuf();
    const test::SvgFile committed = test::read_svg(text.str()), today = test::read_svg(sheet.svg);
    const std::string cure = "fly and record paper and paper-fixed, and draw them again with gyre report";
    ASSERT_EQ(committed.complaint, "") << sheet.name;
    for (const char* tag : {"title", "desc", "style"})
      EXPECT_EQ(committed.all(tag).at(0).text, today.all(tag).at(0).text) << cure;
    for (const char* words : {"paper", "paper-fixed", "\u2713 inside its certificate"})
      EXPECT_TRUE(committed.says(words)) << words << ": " << cure;
  }
}

TEST(ReportFlight, ForeignWordsStayWords) {
  PerfectSwarm swarm(test::shipped_mission("paper"));
  swarm.mission.name = "<script>alert(1)</script> & \"more\"";
  FileFacts file = whole_file("<b>.mcap");
  file.begin = {{"begin", "<i>"}, {"version", "\x01&"}};
  std::vector<Account> accounts;
  accounts.push_back(account_of(swarm, file));
  const test::SvgFile read = read_page(report_page(accounts, sheets(accounts)));
  EXPECT_EQ(read.complaint, "");
  EXPECT_THAT(read.all("script"), IsEmpty());
  EXPECT_THAT(read.all("b"), IsEmpty());
}

TEST(ReportFlight, TwoOfOneMissionAreToldApartByTheirFiles) {
  std::vector<Account> accounts;
  accounts.push_back(account_of(PerfectSwarm(test::shipped_mission("paper"))));
  accounts.push_back(account_of(PerfectSwarm(test::shipped_mission("paper")), whole_file("folder/b.mcap")));
  tell_apart(accounts);
  EXPECT_EQ(accounts[0].name, "paper (folder/a.mcap)");
  EXPECT_EQ(accounts[1].name, "paper (folder/b.mcap)");
}

}  // namespace
}  // namespace gyre::ground
