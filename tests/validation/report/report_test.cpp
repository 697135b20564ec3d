// The report says what passed, what failed and what is missing, and shows foreign text as text.
#include "tests/validation/report/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/validation/report/svg_plot.hpp"

namespace seaway::validation {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

CaseRecord small_case() {
  CaseRecord r;
  r.name = "column";
  r.what = "a column falls";
  r.form = "quick";
  r.code = "1";
  r.ended = "2026-01-01T00:00:00Z";
  r.lines = {{"column", "front", 0.02, "1", std::nullopt, 0.05, true, 1.5}};
  r.plots = {{"front", "t", "z", {{"computed", {0, 1, 2}, {0, 1, 4}, false}, {"measured", {0, 2}, {0, 4.2}, true}}, false}};
  r.refinements = {{"height", "m", {1, 2, 4}, {5.3, 6.2, 9.8}, 2, 5.1, 0.1, 0}};
  return r;
}

TEST(Report, HasTablesPlotsAndUncertainties) {
  const ReportInput input{{small_case()}, {}, "1"};
  const std::string html = report_html(input);
  EXPECT_THAT(html, HasSubstr("1 cases, 1 quantities, 0 failed"));
  EXPECT_THAT(html, HasSubstr("<svg"));
  EXPECT_THAT(html, HasSubstr("Grid convergence"));
  EXPECT_THAT(html, Not(HasSubstr("class='fail'")));
  const auto json = report_json(input);
  const auto& r = json["cases"][0]["refinements"][0];
  EXPECT_NEAR(r["order"].get<double>(), 2, 1e-6);
  EXPECT_NEAR(r["extrapolated"].get<double>(), 5, 1e-9);
  EXPECT_NEAR(r["expanded_uncertainty"].get<double>(), 0.48, 1e-6);
  EXPECT_NEAR(r["comparison_error"].get<double>(), 0.2, 1e-12);
  EXPECT_NEAR(r["u_val"].get<double>(), 0.26, 1e-6);  // 0.24 numerical, 0.1 measured
  EXPECT_EQ(r["significant"], false);
}

TEST(Report, IsOneFileWithoutScriptsOrLinksOutside) {
  const std::string html = report_html({{small_case()}, {}, "1"});
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("src=")));
  EXPECT_THAT(html, Not(HasSubstr("href='http")));
}

TEST(Report, SaysWhatFailedAndWhatIsMissing) {
  CaseRecord bad = small_case();
  bad.lines[0].pass = false;
  bad.lines.push_back({"column", "error", std::nan(""), "1", std::nullopt, std::nullopt, false, 0});
  bad.error = "diverged at t = 1";
  const ReportInput input{{small_case(), bad}, {"waves"}, "2"};
  const std::string html = report_html(input);
  EXPECT_THAT(html, HasSubstr("2 cases, 3 quantities, 2 failed"));
  EXPECT_THAT(html, HasSubstr("<td class='fail'>FAIL</td>"));
  EXPECT_THAT(html, HasSubstr("Not finished: diverged at t = 1"));
  EXPECT_THAT(html, HasSubstr("Not finished: waves"));
  EXPECT_THAT(html, HasSubstr("another than that of this report"));
  const auto json = report_json(input);
  EXPECT_EQ(json["summary"]["failed"], 2);
  EXPECT_EQ(json["summary"]["missing"][0], "waves");
  EXPECT_TRUE(json["cases"][1]["lines"][1]["value"].is_null());
}

TEST(Report, ShowsForeignTextAsText) {
  EXPECT_EQ(escaped("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
  CaseRecord r = small_case();
  r.what = r.lines[0].quantity = r.lines[0].unit = r.plots[0].title = r.plots[0].x_label = r.plots[0].curves[0].label =
      r.refinements[0].quantity = r.error = r.ended = r.form = "<script>alert('x')</script>";
  const std::string html = report_html({{r}, {"<script>"}, "<script>"});
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;"));
}

TEST(Report, LeavesOutWhatCannotBeCompared) {
  CaseRecord r = small_case();
  r.refinements = {{"one mesh", "m", {1}, {5}, 2, std::nullopt, 0, 0}, {"a gap", "m", {1, 2}, {5, std::nan("")}, 2, std::nullopt, 0, 0}};
  r.plots[0].curves = {{"nothing", {}, {}, false}, {"not numbers", {0}, {std::nan("")}, false}};
  const ReportInput input{{r}, {}, "1"};
  EXPECT_THAT(report_html(input), HasSubstr("one mesh, or a value is missing"));
  EXPECT_FALSE(report_json(input)["cases"][0]["refinements"][1].contains("order"));
}

TEST(SvgPlot, ThinsLongCurvesAndKeepsTheirPeaks) {
  Curve c{"signal", {}, {}, false};
  for (int i = 0; i < 20000; ++i) {
    c.x.push_back(i);
    c.y.push_back(i == 12345 ? 100.0 : std::sin(0.01 * i));
  }
  const std::string with = svg_of({"t", "x", "y", {c}, false});
  EXPECT_LT(with.size(), 8000u);
  c.y[12345] = 0;
  // The axis reaches 100 with the peak, 1 without it.
  EXPECT_THAT(with, HasSubstr(">100<"));
  EXPECT_THAT(svg_of({"t", "x", "y", {c}, false}), Not(HasSubstr(">100<")));
}

TEST(SvgPlot, LogarithmicAxesLeaveOutWhatIsNotPositive) {
  const std::string svg = svg_of({"error", "h", "e", {{"e", {1, 2, 4, 8}, {0.01, 0.04, 0.16, -1}, false}}, true});
  EXPECT_THAT(svg, HasSubstr(">0.1<"));
  EXPECT_EQ(svg_of({"error", "h", "e", {{"e", {1}, {-1}, false}}, true}), "");
}

TEST(SvgPlot, TicksAreRound) {
  EXPECT_EQ(ticks_between(0.1, 5.2), (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(ticks_between(-0.02, 0.9).size(), 5u);
}

}  // namespace
}  // namespace seaway::validation
