#include "harness/web/request_check.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace harness {

namespace {

constexpr PageAddress known{"127.0.0.1", 8080, "0123abcd"};

PageRequest good() { return {"GET", "/?token=0123abcd", "127.0.0.1:8080", "", false}; }

PageRequest good_socket() {
  return {"GET", "/socket?token=0123abcd", "127.0.0.1:8080", "http://127.0.0.1:8080", true};
}

}  // namespace

TEST(AnswerTo, GivesThePageAndItsSocketToWhoKnowsTheToken) {
  EXPECT_EQ(answer_to(good(), known), Answer::page);
  EXPECT_EQ(answer_to(good_socket(), known), Answer::socket);
  PageRequest request = good();
  request.target = "/?a=b&token=0123abcd";
  EXPECT_EQ(answer_to(request, known), Answer::page);
  request = good_socket();
  request.host = "localhost:8080";
  request.origin = "http://localhost:8080";
  EXPECT_EQ(answer_to(request, known), Answer::socket);
}

TEST(AnswerTo, RefusesWhoDoesNotKnowTheToken) {
  for (const char* target : {"/", "/?token=", "/?token=0123abce", "/?token=0123abcd0", "/?tokens=0123abcd",
                             "/socket?token=x", "/?x=token=0123abcd"}) {
    PageRequest request = good();
    request.target = target;
    EXPECT_EQ(answer_to(request, known), Answer::forbidden) << target;
  }
}

TEST(AnswerTo, RefusesOtherOriginsAndForeignNamesOfThisMachine) {
  PageRequest request = good_socket();
  request.origin = "http://evil.example";
  EXPECT_EQ(answer_to(request, known), Answer::forbidden);
  request.origin = "null";
  EXPECT_EQ(answer_to(request, known), Answer::forbidden);
  request = good_socket();
  request.host = "evil.example:8080";
  request.origin = "http://evil.example:8080";
  EXPECT_EQ(answer_to(request, known), Answer::forbidden);
}

TEST(AnswerTo, TakesAnyNameOfAServerThatListensEverywhere) {
  PageRequest request = good_socket();
  request.host = "classroom.example:8080";
  request.origin = "http://classroom.example:8080";
  EXPECT_EQ(answer_to(request, {"0.0.0.0", 8080, "0123abcd"}), Answer::socket);
  request.origin = "http://evil.example";
  EXPECT_EQ(answer_to(request, {"0.0.0.0", 8080, "0123abcd"}), Answer::forbidden);
}

TEST(AnswerTo, KnowsOnePageAndOneMethod) {
  PageRequest request = good();
  request.target = "/etc/passwd?token=0123abcd";
  EXPECT_EQ(answer_to(request, known), Answer::not_found);
  request = good();
  request.method = "POST";
  EXPECT_EQ(answer_to(request, known), Answer::bad_method);
  request = good_socket();
  request.wants_socket = false;
  EXPECT_EQ(answer_to(request, known), Answer::not_found);
}

TEST(RandomToken, IsLongAndNeverTheSame) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(random_token());
  EXPECT_EQ(tokens.size(), 100U);
  EXPECT_EQ(tokens.begin()->size(), 32U);
}

}  // namespace harness
