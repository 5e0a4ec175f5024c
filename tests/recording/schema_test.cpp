// The .msg texts: the same layout as the IDL, whole with all they use, and one for everything that has a topic.

#include <gmock/gmock.h>

#include <array>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <tuple>

#include "common/dds/topics.hpp"
#include "ground/recording/core/schemas.hpp"
#include "tests/places.hpp"

namespace gyre::tests {
namespace {

using testing::HasSubstr;

/// Type and name of each field, in order, both spelled as a .msg spells them.
using Fields = std::vector<std::pair<std::string, std::string>>;

std::string whole_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(test::source_directory() + "/" + path).rdbuf();
  return text.str();
}

std::string msg_name_of(const std::string& idl_type) {
  static const std::map<std::string, std::string> kPrimitives{{"double", "float64"}, {"boolean", "bool"}};
  const auto known = kPrimitives.find(idl_type);
  return known == kPrimitives.end() ? idl_type : known->second;
}

std::map<std::string, Fields> fields_of_idl() {
  const std::string idl = std::regex_replace(whole_file("idl/gyre_msgs.idl"), std::regex("//[^\n]*"), "");
  const std::regex structure(R"(struct (\w+) \{([^}]*)\})");
  const std::regex field(R"((sequence<(\w+), (\d+)>|string<(\d+)>|\w+)\s+(\w+)(\[\d+\])?;)");
  std::map<std::string, Fields> all;
  for (std::sregex_iterator s(idl.begin(), idl.end(), structure), end; s != end; ++s) {
    const std::string body = (*s)[2];
    for (std::sregex_iterator f(body.begin(), body.end(), field); f != end; ++f) {
      std::string type = msg_name_of((*f)[1]);
      if ((*f)[2].matched) type = msg_name_of((*f)[2]) + "[<=" + (*f)[3].str() + "]";
      if ((*f)[4].matched) type = "string<=" + (*f)[4].str();
      all[(*s)[1]].emplace_back(type + (*f)[6].str(), (*f)[5]);
    }
  }
  return all;
}

Fields fields_of_msg(const std::string& text) {
  Fields fields;
  std::istringstream lines(std::regex_replace(text, std::regex("#[^\n]*"), ""));
  for (std::string type, name; lines >> type >> name;) fields.emplace_back(type, name);
  return fields;
}

TEST(Schema, HasTheFieldsOfTheIdlInOrder) {
  const auto idl = fields_of_idl();
  ASSERT_GT(idl.size(), 20U);
  std::size_t texts = 0;
  for (const ground::EmbeddedText& text : ground::message_texts()) {
    const std::string name = text.name;
    if (name.rfind("gyre_msgs/", 0) != 0) continue;
    const std::string type = name.substr(name.rfind('/') + 1, name.rfind('.') - name.rfind('/') - 1);
    ASSERT_EQ(idl.count(type), 1U) << type << " is not in the IDL";
    EXPECT_EQ(fields_of_msg(text.content), idl.at(type)) << type;
    ++texts;
  }
  EXPECT_EQ(texts, idl.size()) << "one text for each struct";
}

template <class... Messages>
std::vector<const char*> wire_types(std::tuple<Messages...> /*all*/) {
  return {dds::kTopic<Messages>.type...};
}

TEST(Schema, IsThereForEverythingThatHasATopic) {
  for (const char* wire_type : wire_types(dds::EveryMessage{})) {
    const auto type = ground::type_of_wire_name(wire_type);
    ASSERT_TRUE(type) << wire_type;
    EXPECT_TRUE(ground::schema_text(*type)) << *type;
  }
}

// A message that is added to topics.hpp and not to the list would not be recorded.
TEST(Schema, EveryTopicIsInTheListOfWhatIsRecorded) {
  const std::string topics = whole_file("common/dds/topics.hpp");
  const std::regex defined(R"(constexpr Topic kTopic<protocol::\w+>)");
  const auto count = std::distance(std::sregex_iterator(topics.begin(), topics.end(), defined), std::sregex_iterator());
  EXPECT_EQ(static_cast<std::size_t>(count), std::tuple_size_v<dds::EveryMessage>);
}

TEST(Schema, ComesWithWhatItUsesOnceEach) {
  const std::string line = std::string(80, '=') + "\n";
  const auto text = ground::schema_text("geometry_msgs/msg/PoseStamped");
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "std_msgs/Header header\nPose pose\n" + line +
                       "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\n" + "string frame_id\n" + line +
                       "MSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n" + line +
                       "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + line +
                       "MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" + line +
                       "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n");
  EXPECT_FALSE(ground::schema_text("gyre_msgs/msg/Nothing"));
}

TEST(Schema, NamesAreThoseOfRos) {
  EXPECT_EQ(ground::type_of_wire_name("gyre_msgs::msg::dds_::Beacon_"), "gyre_msgs/msg/Beacon");
  EXPECT_EQ(ground::type_of_wire_name("Beacon"), std::nullopt);
  EXPECT_EQ(ground::topic_of_wire_name("rt/gyre/phase"), "/gyre/phase");
}

}  // namespace
}  // namespace gyre::tests
