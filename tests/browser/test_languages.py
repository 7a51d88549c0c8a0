import re
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.browser.viewing import cell_page, choose, ready
from tests.reports.sample_results import AMBIGUOUS_PIXEL

pytestmark = pytest.mark.clause("REP-13")

CHINESE = {"locale": "zh-CN"}
OURS = """() => {
  const found = [];
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const parent = texts.currentNode.parentElement;
    const isOurs = !parent.closest("[translate=no], script, style, code, kbd, option, .line");
    if (isOurs) found.push(texts.currentNode.data.trim());
  }
  for (const element of document.querySelectorAll("[aria-label], [title]")) {
    if (element.closest("[translate=no]")) continue;
    found.push(element.getAttribute("aria-label") ?? element.title);
  }
  return found;
}"""
KNOWN = re.compile(
    r"raytruth|English|sRGB|PSNR|SSIM|FLIP|RMSE|radiometric|mitsuba ended|povray|closed_form|mitsuba|[xy]|px|e-?\d+"
)
"""Names, abbreviations, and the words of the sample's renderers."""


def english_left(page: Page) -> list[str]:
    """What is shown in English words although the page is in Chinese."""
    texts: list[str] = page.evaluate(OURS)
    return [
        text
        for text in texts
        if re.search(r"[A-Za-z]", text) and not re.search(r"[\u4e00-\u9fff]", text) and not KNOWN.search(text)
    ]


def test_the_overview_is_in_chinese_for_a_chinese_browser(visit: Any) -> None:
    opened = visit(**CHINESE)
    page = opened.page
    assert page.evaluate("document.documentElement.lang") == "zh-CN"
    expect(page.locator("h1")).to_have_text(
        "可比单元 9 个，其中1 个符合声明但并非应有值、1 个失败、1 个失败（已豁免）、1 个出错"
    )
    assert english_left(page) == []
    assert opened.complaints == []


def test_a_cell_is_in_chinese_with_its_reason_and_its_pixel(visit: Any, report: Path) -> None:
    page = ready(visit(path=cell_page(report), **CHINESE).page)
    expect(page.locator(".reason").first).to_have_text("4,096 个像素中有 147 个落在可行集之外")
    choose(page, *AMBIGUOUS_PIXEL)
    expect(page.locator(".outcome")).to_have_text(
        "像素 (33, 50)：✓ 在其 3 个可行结果之内，距最近者的中点 0.365 个容差。"
    )
    page.keyboard.press("Control+k")
    assert english_left(page) == []


def test_the_language_can_be_switched_and_is_kept(visit: Any, report: Path) -> None:
    page = visit(locale="en-GB").page
    page.get_by_role("button", name="中文").click()
    expect(page.locator("#matrix-title")).to_have_text("矩阵")
    page.goto(cell_page(report).as_uri())
    ready(page)
    expect(page.locator(".layers button").first).to_contain_text("真值")
    page.get_by_role("button", name="English").click()
    expect(page.locator(".layers button").first).to_contain_text("Truth")
