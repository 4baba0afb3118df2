#include "majorant/pictures/write_comparison.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/comparison/comparison_samples.h"
#include "io/io_test_helpers.h"

namespace majorant::comparison_files {
namespace {

using Json = nlohmann::json;

// Returns the records of a CSV file by RFC 4180, with lines that end with \n.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
  std::vector<std::vector<std::string>> records(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      records.back().back() += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      records.back().emplace_back();
    } else if (!quoted && c == '\n') {
      records.push_back({""});
    } else {
      records.back().back() += c;
    }
  }
  EXPECT_FALSE(quoted);
  EXPECT_EQ(records.back(), std::vector<std::string>{""}) << "the last line has no end";
  records.pop_back();
  return records;
}

std::string page_of(const Comparison& comparison) {
  const TemporaryFolder folder;
  write_comparison_html(folder.file("a.html"), comparison);
  return content_of(folder.file("a.html"));
}

Json data_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = page.find(open) + open.size();
  return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t result = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) {
    ++result;
  }
  return result;
}

void expect_same(double a, double b) {
  EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << a << " " << b;
}

TEST(WriteComparisonCsv, ReadsBackEqual) {
  const TemporaryFolder folder;
  auto all = odd_comparisons();
  all.emplace_back("usual", usual_comparison());
  for (const auto& [name, comparison] : all) {
    SCOPED_TRACE(name);
    write_comparison_csv(folder.file("a.csv"), comparison);
    const auto records = parse_csv(content_of(folder.file("a.csv")));
    std::vector<std::string> head{"method", "iteration",     "seconds",
                                  "energy", "gradient_norm", "step"};
    head.push_back(name == "hostile" ? records[0].back() : "min_det");  // text of the caller
    EXPECT_EQ(records[0], head);
    std::size_t line = 1;
    for (const MethodRun& run : comparison.runs) {
      for (const ComparisonPoint& point : run.points) {
        ASSERT_LT(line, records.size());
        const auto& record = records[line++];
        ASSERT_EQ(record.size(), 7u);
        EXPECT_EQ(record[0], run.method);
        EXPECT_EQ(std::stoi(record[1]), point.iteration);
        const auto number = [&](std::size_t i) { return std::strtod(record[i].c_str(), nullptr); };
        expect_same(number(2), point.seconds);
        expect_same(number(3), point.energy);
        expect_same(number(4), point.gradient_norm);
        expect_same(number(5), point.step);
        expect_same(number(6), point.measure);
      }
    }
    EXPECT_EQ(line, records.size());
  }
}

TEST(WriteComparisonCsv, QuotesOnlyWhatNeedsIt) {
  const TemporaryFolder folder;
  Comparison all{"t", "m", {}, {}, "min det"};
  for (const char* name : {"plain name", "a,b", "say \"hi\"", "two\nlines"}) {
    all.runs.push_back(run_of_energies(name, {0.1}));
  }
  write_comparison_csv(folder.file("a.csv"), all);
  EXPECT_EQ(content_of(folder.file("a.csv")),
            "method,iteration,seconds,energy,gradient_norm,step,min_det\n"
            "plain name,0,0,0.1,1,1,0.5\n"
            "\"a,b\",0,0,0.1,1,1,0.5\n"
            "\"say \"\"hi\"\"\",0,0,0.1,1,1,0.5\n"
            "\"two\nlines\",0,0,0.1,1,1,0.5\n");
}

TEST(WriteComparisonHtml, IsOneSelfContainedPage) {
  auto all = odd_comparisons();
  all.emplace_back("usual", usual_comparison());
  for (const auto& [name, comparison] : all) {
    SCOPED_TRACE(name);
    const std::string page = page_of(comparison);
    EXPECT_EQ(page, page_of(comparison));
    EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0u);
    EXPECT_EQ(count(page, "http:"),
              count(page, "http://www.w3.org/2000/svg"));  // a name, not an address
    for (const char* piece : {"https:", "src=", "@import", "url(", "NaN,", "Infinity]"}) {
      EXPECT_EQ(count(page, piece), 0u) << piece;
    }
    EXPECT_EQ(count(page, "href="), 1u);  // the empty icon
    EXPECT_EQ(count(page, "<script"), 2u);
    EXPECT_EQ(count(page, "</script"), 2u);
    EXPECT_EQ(count(page, "<!--"), 0u);
    EXPECT_EQ(count(page, "<b "), 0u);
    EXPECT_EQ(count(page, "<th scope=\"row\">"), comparison.runs.size());
    EXPECT_LT(page.size(), 3u << 20);
    EXPECT_EQ(data_of(page)["runs"].size(), comparison.runs.size());
  }
}

// The first columns are those by which methods are compared.
TEST(WriteComparisonHtml, TheComparedValueComesFirst) {
  const std::string page = page_of(usual_comparison());
  const std::string head = page.substr(page.find("<thead>"), page.find("</thead>"));
  EXPECT_LT(head.find(">method<"), head.find("to within 1&nbsp;%"));
  EXPECT_LT(head.find("to within 0.01&nbsp;%"), head.find(">status<"));
  const std::string row = page.substr(page.find("<th scope=\"row\">"));
  EXPECT_LT(row.find("<td class=\"group\">"), row.find("<td class=\"text group\">"));
}

TEST(WriteComparisonHtml, DataReadsBack) {
  const Comparison comparison = usual_comparison();
  const Json data = data_of(page_of(comparison));
  EXPECT_EQ(data["title"], comparison.title);
  EXPECT_EQ(data["machine"], comparison.machine);
  EXPECT_EQ(data["best"], comparison.best_energy());
  for (std::size_t r = 0; r < comparison.runs.size(); ++r) {
    const MethodRun& run = comparison.runs[r];
    const Json& json = data["runs"][r];
    EXPECT_EQ(json["method"], run.method);
    EXPECT_EQ(json["status"], run.status);
    ASSERT_EQ(json["energy"].size(), run.points.size());
    for (std::size_t i = 0; i < run.points.size(); ++i) {
      const ComparisonPoint& point = run.points[i];
      EXPECT_EQ(json["iteration"][i], point.iteration);
      // with all digits, since the excess is a difference
      EXPECT_EQ(json["energy"][i], point.energy);
      EXPECT_NEAR(json["seconds"][i].get<double>(), point.seconds, 1e-5 * point.seconds);
      EXPECT_NEAR(json["measure"][i].get<double>(), point.measure, 1e-5 * point.measure);
      EXPECT_EQ(json["step"][i].is_null(), i == 0);
    }
  }
}

TEST(WriteComparisonHtml, NoNumberIsNull) {
  for (const auto& [name, comparison] : odd_comparisons()) {
    if (name != "not_finite" && name != "never_finite") continue;
    const Json data = data_of(page_of(comparison));
    EXPECT_EQ(data["best"].is_null(), name == "never_finite");
    const auto& points = comparison.runs[0].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(data["runs"][0]["energy"][i].is_null(), !std::isfinite(points[i].energy));
    }
  }
}

TEST(WriteComparisonHtml, TextsMayHoldAnything) {
  const std::string text =
      "</script><script>x()</script><!-- {{body}} \"quoted\" 'q' & \xc3\xa9\n\t";
  Comparison comparison{text, text, {{text, text, text, {}}}};
  std::string page = page_of(comparison);
  EXPECT_EQ(count(page, "x()</script>"), 0u);
  EXPECT_EQ(count(page, "<!--"), 0u);
  EXPECT_NE(page.find("<h1>&lt;/script&gt;&lt;script&gt;x()&lt;/script&gt;&lt;!-- {{body}} "
                      "&quot;quoted&quot; 'q' &amp; \xc3\xa9\n\t</h1>"),
            std::string::npos);
  EXPECT_EQ(data_of(page)["title"], text);
  EXPECT_EQ(data_of(page)["runs"][0]["method"], text);

  comparison.title = "not UTF-8: \xff, cut: \xc3";
  comparison.machine = std::string("a\0b", 3);
  page = page_of(comparison);
  EXPECT_EQ(data_of(page)["title"], "not UTF-8: \xef\xbf\xbd, cut: \xef\xbf\xbd");
  EXPECT_EQ(page.find('\0'), std::string::npos);
}

TEST(WriteComparisonHtml, LongRunsAreThinnedWithANote) {
  const Comparison comparison{"",
                              "",
                              {decaying_run("long", 100000, 3.0, 1e-4, 1e-3),
                               decaying_run("short", 1999, 3.0, 1e-2, 1e-3)}};
  const std::string page = page_of(comparison);
  EXPECT_LT(page.size(), 1u << 20);
  EXPECT_NE(page.find("more than 2000 points"), std::string::npos);
  const Json data = data_of(page);
  EXPECT_EQ(data["runs"][1]["iteration"].size(), 2000u);
  const auto kept = data["runs"][0]["iteration"].get<std::vector<int>>();
  EXPECT_LE(kept.size(), 2000u);
  EXPECT_GT(kept.size(), 1500u);
  EXPECT_EQ(data["runs"][0]["count"], 100001);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(std::set<int>(kept.begin(), kept.end()).size(), kept.size());
  EXPECT_EQ(kept.front(), 0);
  EXPECT_EQ(kept.back(), 100000);
  for (std::size_t i = 1; i < kept.size(); ++i) {  // no gap by index or by value
    EXPECT_LE(kept[i] - kept[i - 1], 101);
    EXPECT_LE(kept[i], std::max(kept[i - 1] + 1, static_cast<int>(1.02 * kept[i - 1] + 1.0)));
  }
  EXPECT_EQ(page_of(usual_comparison()).find("more than 2000 points"), std::string::npos);
}

// A measure without any number, such as the distances of a map, has no column.
TEST(WriteComparisonHtml, ColumnsWithoutNumbersAreLeftOut) {
  Comparison comparison = usual_comparison();
  EXPECT_EQ(count(page_of(comparison), ">min det<"), 1u);
  EXPECT_EQ(count(page_of(comparison), ">distance<"), 0u);
  comparison.runs[1].distance = 0.5;
  comparison.measure.clear();
  for (MethodRun& run : comparison.runs)
    for (ComparisonPoint& point : run.points) point.measure = std::nan("");
  const std::string page = page_of(comparison);
  EXPECT_EQ(count(page, ">min det<"), 0u);
  EXPECT_EQ(count(page, ">distance<"), 1u);
  EXPECT_EQ(data_of(page)["measure"], "");
}

TEST(WriteComparisonHtml, NotesAreShown) {
  Comparison comparison = usual_comparison();
  comparison.runs[2].notes = {"a <saddle>"};
  comparison.notes = {"a wrong gradient"};
  for (const std::string& text : {page_of(comparison), comparison_html_table(comparison)}) {
    EXPECT_EQ(count(text, "<small>a &lt;saddle&gt;</small>"), 1u);
    EXPECT_EQ(count(text, "Note: a wrong gradient."), 1u);
  }
}

TEST(WriteComparisonRows, ALineAMethod) {
  const TemporaryFolder folder;
  Comparison comparison = usual_comparison();
  comparison.runs[0].factorizations = 31;
  comparison.runs[0].notes = {"one, two", "three"};
  write_comparison_rows(folder.file("r.csv"), comparison);
  const auto records = parse_csv(content_of(folder.file("r.csv")));
  ASSERT_EQ(records.size(), 1 + comparison.runs.size());
  EXPECT_EQ(records[0][0], "method");
  EXPECT_EQ(records[0].back(), "notes");
  EXPECT_EQ(records[1][3], "31");
  EXPECT_EQ(records[1].back(), "one, two; three");
  EXPECT_EQ(std::strtod(records[1][9].c_str(), nullptr), comparison.runs[0].points.back().energy);
}

TEST(WriteComparison, FilesAreCompleteOrMissing) {
  const TemporaryFolder folder;
  const Comparison comparison = usual_comparison();
  const std::string path = folder.file("no/such/folder");
  for (const auto write : {write_comparison_csv, write_comparison_html}) {
    const std::string message = error_message(ErrorKind::Usage, [&] { write(path, comparison); });
    EXPECT_NE(message.find(path), std::string::npos);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace majorant::comparison_files

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
