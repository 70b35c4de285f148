//! `antumbra bench`: how long frames take with each technique, as tables and charts.

mod chart;
mod figures;
mod penumbra;
mod report;

use std::io::{self, Write};
use std::path::PathBuf;

use antumbra_host::Stage;
use antumbra_scene::Scene;
use clap::ValueEnum;

use crate::args::{BenchArgs, FigureName};
use crate::draw::{Driver, open_context};
use crate::error::CliError;
use crate::output::plan::{check_directory, check_file};
use crate::output::staged::Staged;
use crate::progress::Progress;
use crate::report::texts;
use crate::technique::Technique;
use crate::timing::Contest;
use figures::{Figure, Place};
use report::{Refusal, Report, Row};

/// Measures.
///
/// # Errors
/// Techniques that can do nothing of what is asked, and whatever is wrong with files or OpenGL.
pub(crate) fn run(arguments: &BenchArgs) -> Result<(), CliError> {
    let names = arguments.figure.map_or(FigureName::value_variants().to_vec(), |name| vec![name]);
    let figures: Vec<Figure> = names.iter().map(|name| name.figure(arguments.size)).collect();
    let plan = Plan::new(arguments, &figures)?;
    let contests: Vec<Vec<Technique>> = figures.iter().map(|figure| techniques(arguments, figure)).collect();
    let on_gl = contests.iter().flatten().any(|technique| *technique != Technique::Raytraced);
    let context = on_gl.then(open_context).transpose().map_err(CliError::without_opengl)?;

    let mut report = Report::new(context.as_ref().map(|context| Driver::from(&context.info())));
    let progress = Progress::new("measuring", "rounds");
    let places: usize = figures.iter().map(|figure| figure.places.len()).sum();
    let rounds = u64::from(Contest::rounds(arguments.frames));
    let (mut done, all) = (0, rounds * places as u64);
    for (figure, techniques) in figures.iter().zip(&contests) {
        let mut contest = Contest::new(context.as_ref(), techniques)?;
        let mut stage = match &context {
            Some(context) if figure.has_error() => Some(Stage::new(context.gl()).map_err(CliError::OpenGl)?),
            _ => None,
        };
        for place in &figure.places {
            progress.message(&place.scene);
            let mut told = |round: u32| progress.set(done + u64::from(round), all);
            measure(&mut contest, figure, place, techniques, arguments.frames, &mut told, &mut report)?;
            done += rounds;
            if let Some(stage) = &mut stage {
                penumbra::measure(stage, place, techniques, &mut report)?;
            }
        }
    }
    drop(progress);
    if report.rows.is_empty() {
        let first = report.refused.first().map_or_else(String::new, |refusal| refusal.to_string());
        return Err(CliError::Usage(format!("nothing can be measured: {first}")));
    }
    plan.write(&figures, &mut report)?;
    report.print(arguments.json)
}

/// The techniques of a figure, each once.
fn techniques(arguments: &BenchArgs, figure: &Figure) -> Vec<Technique> {
    let asked = if arguments.techniques.is_empty() {
        figure.techniques.clone()
    } else {
        arguments.techniques.clone()
    };
    let mut techniques = Vec::new();
    for technique in asked {
        if !techniques.contains(&technique) {
            techniques.push(technique);
        }
    }
    techniques
}

/// Measures one place of a figure with every technique that can do its scene.
fn measure(
    contest: &mut Contest,
    figure: &Figure,
    place: &Place,
    techniques: &[Technique],
    frames: u32,
    told: &mut dyn FnMut(u32),
    report: &mut Report,
) -> Result<(), CliError> {
    let scene = Scene::parse(&place.toml, format!("{}.toml", place.scene).as_ref())?;
    let objections: Vec<Option<String>> =
        techniques.iter().map(|technique| technique.objection(&scene, 0.0)).collect();
    let takes_part: Vec<bool> = objections.iter().map(Option::is_none).collect();
    let timings = contest.measure((&scene, 0.0), place.size, frames, &takes_part, told)?;
    for ((technique, timing), objection) in techniques.iter().zip(timings).zip(objections) {
        if let Some(timing) = timing {
            report.rows.push(Row::new(figure.name, technique, place, &scene, timing));
        } else if let Some(reason) = objection {
            let technique = technique.to_string();
            report.refused.push(Refusal { technique, scene: place.scene.clone(), reason });
        }
    }
    Ok(())
}

/// The files that are written.
struct Plan {
    directory: PathBuf,
    scenes: PathBuf,
    json: PathBuf,
    csv: PathBuf,
    charts: Vec<PathBuf>,
    /// A file for each place of each figure, in order.
    places: Vec<PathBuf>,
}

impl Plan {
    /// Checks that all can be written, before the long work.
    fn new(arguments: &BenchArgs, figures: &[Figure]) -> Result<Self, CliError> {
        let directory = arguments.output.clone();
        let scenes = directory.join("scenes");
        let places = figures.iter().flat_map(|figure| &figure.places);
        let plan = Self {
            json: directory.join("bench.json"),
            csv: directory.join("bench.csv"),
            charts: figures.iter().flat_map(Figure::charts).map(|(_, file)| directory.join(file)).collect(),
            places: places.map(|place| scenes.join(format!("{}.toml", place.scene))).collect(),
            directory,
            scenes,
        };
        check_directory(&plan.directory)?;
        if plan.directory.is_dir() {
            check_directory(&plan.scenes)?;
        }
        for file in plan.files() {
            check_file(file)?;
        }
        Ok(plan)
    }

    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.json, &self.csv].into_iter().chain(&self.charts).chain(&self.places)
    }

    fn write(&self, figures: &[Figure], report: &mut Report) -> Result<(), CliError> {
        report.files = texts(&self.files().cloned().collect::<Vec<_>>());
        let report = &*report;
        let mut staged = Staged::default();
        staged.directory(&self.directory)?;
        staged.directory(&self.scenes)?;
        staged.file(&self.json, |to| {
            serde_json::to_writer_pretty(&mut *to, report)?;
            to.write_all(b"\n")
        })?;
        staged.file(&self.csv, |to| {
            let mut table = csv::Writer::from_writer(to);
            report.rows.iter().try_for_each(|row| table.serialize(row)).map_err(io::Error::other)?;
            table.flush()
        })?;
        let charts = figures
            .iter()
            .flat_map(|figure| figure.charts().into_iter().map(move |(shown, _)| (figure, shown)));
        for (path, (figure, shown)) in self.charts.iter().zip(charts) {
            staged.file(path, |to| to.write_all(chart::svg(figure, shown, report)?.as_bytes()))?;
        }
        let places = figures.iter().flat_map(|figure| &figure.places);
        for (path, place) in self.places.iter().zip(places) {
            staged.file(path, |to| to.write_all(place.toml.as_bytes()))?;
        }
        staged.commit()
    }
}
