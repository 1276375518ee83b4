#include "text/text_mask.h"

#include <cairo.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.h"

namespace dstylize {
namespace {

struct Unref {
    void operator()(void* object) const { g_object_unref(object); }
    void operator()(PangoFontDescription* d) const { pango_font_description_free(d); }
    void operator()(cairo_t* c) const { cairo_destroy(c); }
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
};
template <class T>
using Handle = std::unique_ptr<T, Unref>;

/// Measured at a large size: metrics are rounded to 1/1024 of a pixel.
constexpr double kMeasure_px = 1000;

Error refusal(const std::string& problem, const std::string& remedy) {
    return Error(ErrorCode::bad_usage, "", problem, remedy);
}

bool same_name(const char* a, const std::string& b) { return g_ascii_strcasecmp(a, b.c_str()) == 0; }

/// Fontconfig gives some font for any name: whether it is the one that was asked for is ours to see.
void check_family(PangoContext* context, const std::string& name, const PangoFontDescription* description) {
    const char* given = pango_font_description_get_family(description);
    const std::string family = given ? given : "";
    for (const char* alias : {"sans", "sans-serif", "serif", "monospace", "cursive", "fantasy", "system-ui"})
        if (same_name(alias, family)) return;
    PangoFontFamily** families = nullptr;
    int count = 0;
    pango_context_list_families(context, &families, &count);
    const std::unique_ptr<PangoFontFamily*, decltype(&g_free)> owner(families, &g_free);
    for (int k = 0; k < count; ++k)
        if (same_name(pango_font_family_get_name(families[k]), family)) return;
    throw refusal("no font called '" + name + "' is installed", "`fc-list : family` lists those that are");
}

bool is_blank(const std::string& text) {
    for (const char* at = text.c_str(); *at; at = g_utf8_next_char(at))
        if (!g_unichar_isspace(g_utf8_get_char(at))) return false;
    return true;
}

/// The first character that no font has, as users can look it up.
std::string unknown_character(PangoLayout* layout) {
    const char* text = pango_layout_get_text(layout);
    const Handle<PangoLayout> one(pango_layout_copy(layout));
    for (const char* at = text; *at; at = g_utf8_next_char(at)) {
        pango_layout_set_text(one.get(), at, int(g_utf8_next_char(at) - at));
        if (pango_layout_get_unknown_glyphs_count(one.get()) == 0) continue;
        char code[16];
        g_snprintf(code, sizeof code, "U+%04X", g_utf8_get_char(at));
        return std::string(at, std::size_t(g_utf8_next_char(at) - at)) + " (" + code + ")";
    }
    return "of the text";
}

Handle<PangoLayout> layout(const Lettering& lettering, double em_px) {
    if (!g_utf8_validate(lettering.text.data(), gssize(lettering.text.size()), nullptr))
        throw refusal("the text is not UTF-8", "use a UTF-8 terminal or file");
    if (is_blank(lettering.text)) throw refusal("the text is empty", "give at least one letter");
    const Handle<PangoFontMap> map(pango_cairo_font_map_new());
    const Handle<PangoContext> context(pango_font_map_create_context(map.get()));
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    pango_cairo_context_set_font_options(context.get(), options);
    cairo_font_options_destroy(options);

    const Handle<PangoFontDescription> font(pango_font_description_from_string(lettering.font.c_str()));
    check_family(context.get(), lettering.font, font.get());
    pango_font_description_set_absolute_size(font.get(), em_px * PANGO_SCALE);
    Handle<PangoLayout> out(pango_layout_new(context.get()));
    pango_layout_set_font_description(out.get(), font.get());
    pango_layout_set_text(out.get(), lettering.text.c_str(), -1);
    pango_layout_set_alignment(out.get(), lettering.align == Lettering::Align::left     ? PANGO_ALIGN_LEFT
                                          : lettering.align == Lettering::Align::centre ? PANGO_ALIGN_CENTER
                                                                                        : PANGO_ALIGN_RIGHT);
    pango_layout_set_line_spacing(out.get(), lettering.line_spacing);
    if (lettering.letter_spacing != 0) {
        PangoAttrList* attributes = pango_attr_list_new();
        pango_attr_list_insert(attributes,
                               pango_attr_letter_spacing_new(int(lettering.letter_spacing * em_px * PANGO_SCALE)));
        pango_layout_set_attributes(out.get(), attributes);
        pango_attr_list_unref(attributes);
    }
    if (pango_layout_get_unknown_glyphs_count(out.get()) > 0)
        throw refusal("no installed font has the character " + unknown_character(out.get()),
                      "install a font of that script, or give --font");
    return out;
}

}  // namespace

InkBox ink_box(const Lettering& lettering) {
    const Handle<PangoLayout> text = layout(lettering, kMeasure_px);
    PangoRectangle ink;
    pango_layout_get_extents(text.get(), &ink, nullptr);
    const auto em = [](int units) { return float(units / (PANGO_SCALE * kMeasure_px)); };
    if (ink.width <= 0 || ink.height <= 0) throw refusal("the text has nothing to draw", "give at least one letter");
    return {em(ink.x), em(ink.y), em(ink.width), em(ink.height)};
}

Grid<std::uint8_t> text_mask(const Lettering& lettering, Extent frame, float em_px, Vec2f centre_px) {
    const InkBox box = ink_box(lettering);
    const Handle<PangoLayout> text = layout(lettering, double(em_px));
    const Handle<cairo_surface_t> surface(cairo_image_surface_create(CAIRO_FORMAT_A8, frame.x, frame.y));
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
        throw Error(ErrorCode::failed, "", "the letters cannot be drawn that large", "ask for a smaller picture");
    const Handle<cairo_t> cairo(cairo_create(surface.get()));
    cairo_move_to(cairo.get(), double(centre_px.x - em_px * (box.left + box.width / 2)),
                  double(centre_px.y - em_px * (box.top + box.height / 2)));
    pango_cairo_show_layout(cairo.get(), text.get());
    cairo_surface_flush(surface.get());
    Grid<std::uint8_t> out(frame);
    const unsigned char* pixels = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int j = 0; j < frame.y; ++j) std::copy_n(pixels + std::ptrdiff_t(j) * stride, frame.x, out.row(j));
    return out;
}

}  // namespace dstylize
