#include "firmware/desk/journal_view/export/maps/xml.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/desk/journal_view/export/export_rig.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::journal {
namespace {

// Source: XML 1.0, 2.2 (Char) and 2.4 (what stands for markup).
TEST(XmlText, SpellsOutMarkupAndReplacesWhatNoDocumentMayHold) {
  EXPECT_EQ(xml_text("SNR < 3 dB & \"faint\" > 0"), "SNR &lt; 3 dB &amp; &quot;faint&quot; &gt; 0");
  EXPECT_EQ(xml_text(std::string("a\x01"
                                 "b\0c\n\t",
                                 7)),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD"
            "c\n\t");
  EXPECT_EQ(xml_text("\xC3\xA9"), "\xC3\xA9");
}

TEST(XmlFile, ClosesItsElementsInTheOrderInWhichTheyMustBe) {
  const support::TemporaryFolder folder;
  PiecewiseFile file(folder / "a.xml");
  XmlFile xml(file);
  xml.open("a", {{"of", "\"1\""}});
  xml.open("b");
  xml.text("<");
  xml.close();
  xml.element("c", "&");
  xml.close();
  file.commit();
  EXPECT_EQ(text_of(folder / "a.xml"),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a of=\"&quot;1&quot;\">\n<b>&lt;</b>\n<c>&amp;</c></a>\n");
}

}  // namespace
}  // namespace earshot::journal
