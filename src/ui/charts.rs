//! The three deformation charts of a body as the paper draws them (figure 4): the cycle from left to right, rates from `1/A` to
//! `A`, control points to drag, and a red bar that moves with time.

use egui::{Color32, Id, Pos2, Rect, Sense, Stroke, Ui, pos2, vec2};

use crate::procdef::{CHART_NAMES, DeformationCharts, VolumeMode};

/// Height of a chart in points of the screen.
const HEIGHT: f32 = 74.0;

/// A control point is taken within so many points of the screen.
const REACH: f32 = 9.0;

/// Pieces of the drawn line.
const PIECES: u32 = 120;

/// Draws the charts and lets their control points be dragged, added by a double click and removed by a click with the right
/// button. Charts that follow from the primary one are drawn without points. `phase` is where the red bar stands, in
/// cycles. True where something was changed; the charts are always valid.
pub fn charts(ui: &mut Ui, charts: &mut DeformationCharts, phase: Option<f32>) -> bool {
    let mut changed = false;
    for (chart, name) in CHART_NAMES.into_iter().enumerate() {
        let free = chart == 0 || charts.volume == VolumeMode::Free;
        ui.small(if free { name.to_owned() } else { format!("{name} (follows)") });
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::click_and_drag());
        let plot = Plot { rect: rect.shrink2(vec2(5.0, 4.0)), limit: charts.limit };
        if free {
            changed |= edit(ui, &response, &plot, charts, chart);
            response.on_hover_text("Drag a point; double click for a new one; right click removes one");
        }
        draw(ui, &plot, charts, chart, free, phase);
    }
    changed
}

/// The control point that is dragged: its number, kept from frame to frame.
#[derive(Clone, Copy)]
struct Held(usize);

fn edit(ui: &Ui, response: &egui::Response, plot: &Plot, charts: &mut DeformationCharts, chart: usize) -> bool {
    let id = response.id.with("held");
    let Some(at) = response.interact_pointer_pos() else {
        release(ui, id);
        return false;
    };
    let rates = charts.rates();
    let (phase, rate) = plot.value(at);
    let line = &mut charts.charts[chart];
    let nearest = |from: Pos2| {
        let distances = line.points().iter().map(|p| plot.place(p.phase, p.rate).distance(from));
        let nearest = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.filter(|(_, distance)| *distance <= REACH).map(|(point, _)| point)
    };
    if response.double_clicked() {
        return line.add(phase, rate).is_ok();
    }
    if response.secondary_clicked() {
        return nearest(at).is_some_and(|point| line.remove(point).is_ok());
    }
    if response.drag_started() {
        // Where the button went down: the pointer may have moved on since.
        let from = ui.input(|input| input.pointer.press_origin()).unwrap_or(at);
        if let Some(point) = nearest(from) {
            ui.data_mut(|data| data.insert_temp(id, Held(point)));
        }
    }
    let held = ui.data(|data| data.get_temp::<Held>(id));
    if response.drag_stopped() {
        release(ui, id);
    }
    match held {
        Some(Held(point)) if response.dragged() => line.drag(point, phase, rate, rates).is_ok(),
        _ => false,
    }
}

fn release(ui: &Ui, id: Id) {
    ui.data_mut(|data| data.remove::<Held>(id));
}

fn draw(ui: &Ui, plot: &Plot, charts: &DeformationCharts, chart: usize, free: bool, phase: Option<f32>) {
    let visuals = ui.visuals();
    let painter = ui.painter();
    painter.rect_filled(plot.rect.expand2(vec2(5.0, 4.0)), 3.0, visuals.extreme_bg_color);
    let faint = Stroke::new(1.0, visuals.weak_text_color().gamma_multiply(0.4));
    painter.line_segment([plot.place(0.0, 1.0), plot.place(1.0, 1.0)], faint);
    let points = (0..=PIECES).map(|k| {
        let phase = k as f32 / PIECES as f32;
        // The last place is the end of the cycle, which is its beginning.
        plot.place(phase, charts.at(phase)[chart])
    });
    let colour = if free { visuals.strong_text_color() } else { visuals.weak_text_color() };
    painter.add(egui::Shape::line(points.collect(), Stroke::new(1.5, colour)));
    if free {
        for point in charts.charts[chart].points() {
            painter.circle(
                plot.place(point.phase, point.rate),
                4.0,
                visuals.selection.bg_fill,
                Stroke::new(1.0, colour),
            );
        }
    }
    if let Some(phase) = phase {
        let x = plot.place(phase.rem_euclid(1.0), 1.0).x;
        painter.vline(x, plot.rect.y_range(), Stroke::new(2.0, Color32::from_rgb(215, 30, 25)));
    }
}

/// Where phases and rates are on the screen; rates go by their logarithms, so that 1 is in the middle.
struct Plot {
    rect: Rect,
    limit: f32,
}

impl Plot {
    fn place(&self, phase: f32, rate: f32) -> Pos2 {
        let height = (rate.ln() / self.limit.ln()).clamp(-1.0, 1.0);
        pos2(self.rect.left() + phase * self.rect.width(), self.rect.center().y - 0.5 * height * self.rect.height())
    }

    fn value(&self, at: Pos2) -> (f32, f32) {
        let phase = ((at.x - self.rect.left()) / self.rect.width()).clamp(0.0, 0.9999);
        let height = (self.rect.center().y - at.y) / (0.5 * self.rect.height());
        (phase, (height.clamp(-1.0, 1.0) * self.limit.ln()).exp())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procdef::ChartInterpolation;
    use egui::{Event, Modifiers, PointerButton, RawInput};

    fn example() -> DeformationCharts {
        let points = [[0.0, 1.0], [0.5, 0.6]];
        DeformationCharts::volume_preserving(2.0, VolumeMode::Both, &points, ChartInterpolation::Linear).unwrap()
    }

    /// One round of the window with these events; where the first chart is.
    fn round(context: &egui::Context, charts: &mut DeformationCharts, events: Vec<Event>) -> (bool, Plot) {
        let screen = Rect::from_min_size(Pos2::ZERO, vec2(300.0, 400.0));
        let mut result = None;
        let input = RawInput { screen_rect: Some(screen), events, ..RawInput::default() };
        let mut output = context.run_ui(input, |ui| {
            let top = ui.next_widget_position();
            let small = ui.text_style_height(&egui::TextStyle::Small);
            let left_top = top + vec2(0.0, small.max(0.0) + ui.spacing().item_spacing.y);
            let rect = Rect::from_min_size(left_top, vec2(ui.available_width(), HEIGHT)).shrink2(vec2(5.0, 4.0));
            result = Some((super::charts(ui, charts, Some(0.25)), Plot { rect, limit: charts.limit }));
        });
        output.textures_delta.clear();
        result.unwrap()
    }

    fn button(pos: Pos2, button: PointerButton, pressed: bool) -> Event {
        Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }
    }

    #[test]
    fn places_and_values_are_each_others_inverse_and_one_is_in_the_middle() {
        let plot = Plot { rect: Rect::from_min_size(pos2(10.0, 20.0), vec2(200.0, 60.0)), limit: 2.0 };
        for (phase, rate) in [(0.0, 0.5), (0.3, 1.0), (0.9, 1.7)] {
            let (p, r) = plot.value(plot.place(phase, rate));
            assert!((p - phase).abs() < 1e-5 && (r - rate).abs() < 1e-5);
        }
        assert_eq!(plot.place(0.5, 1.0), plot.rect.center());
    }

    #[test]
    fn a_control_point_follows_the_pointer_and_stays_within_the_limits() {
        let (context, mut charts) = (egui::Context::default(), example());
        let (_, plot) = round(&context, &mut charts, Vec::new());
        let from = plot.place(0.5, 0.6);
        round(&context, &mut charts, vec![Event::PointerMoved(from)]);
        round(&context, &mut charts, vec![button(from, PointerButton::Primary, true)]);
        let to = plot.place(0.7, 1.5);
        let (changed, _) = round(&context, &mut charts, vec![Event::PointerMoved(to)]);
        let point = charts.charts[0].points()[1];
        assert!(changed && (point.phase - 0.7).abs() < 0.01 && (point.rate - 1.5).abs() < 0.02, "{point:?}");
        round(&context, &mut charts, vec![Event::PointerMoved(to - vec2(0.0, 500.0))]);
        assert!((charts.charts[0].points()[1].rate - charts.limit).abs() < 1e-4);
        round(&context, &mut charts, vec![button(to, PointerButton::Primary, false)]);
        let (changed, _) = round(&context, &mut charts, vec![Event::PointerMoved(from)]);
        assert!(!changed && charts.charts[0].points().len() == 2, "it was let go");
        assert!(charts.check().is_ok());
    }

    #[test]
    fn a_double_click_adds_a_point_and_the_right_button_removes_one() {
        let (context, mut charts) = (egui::Context::default(), example());
        let (_, plot) = round(&context, &mut charts, Vec::new());
        let at = plot.place(0.25, 1.4);
        round(&context, &mut charts, vec![Event::PointerMoved(at)]);
        for pressed in [true, false, true, false] {
            round(&context, &mut charts, vec![button(at, PointerButton::Primary, pressed)]);
        }
        let phases: Vec<f32> = charts.charts[0].points().iter().map(|p| p.phase).collect();
        assert!(phases.len() == 3 && (phases[1] - 0.25).abs() < 0.01, "{phases:?}");
        for pressed in [true, false] {
            round(&context, &mut charts, vec![button(at, PointerButton::Secondary, pressed)]);
        }
        assert_eq!(charts.charts[0].points().len(), 2);
    }
}
