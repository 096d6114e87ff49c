// Sections, tables and lists of a web page, in which all that is handed over as text stays text.
#pragma once

#include <string>
#include <vector>

#include "app/html.h"

namespace lucarne {

class PageWriter {
 public:
  void heading(const std::string& text) { html_ += "<h2>" + escapeHtml(text) + "</h2>\n"; }
  void paragraph(const std::string& text) { html_ += "<p>" + escapeHtml(text) + "</p>\n"; }
  void note(const std::string& text) { html_ += "<p class=\"note\">" + escapeHtml(text) + "</p>\n"; }
  void code(const std::string& text) { html_ += "<pre>" + escapeHtml(text) + "</pre>\n"; }
  void list(const std::vector<std::string>& items, const char* kind = "plain");
  void picture(const std::string& title, const std::string& caption, int width, int height,
               const std::vector<std::uint8_t>& png);

  /// A row of cells; the first is the row's name. Numbers stand right.
  using Row = std::vector<std::string>;
  void table(const Row& head, const std::vector<Row>& rows, bool numbers = true);

  /// Markup of our own making.
  void raw(const std::string& html) { html_ += html; }
  const std::string& html() const { return html_; }

 private:
  std::string html_;
};

}  // namespace lucarne
