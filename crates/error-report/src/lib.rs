//! Error against run time: figures, one file format, one page.
//!
//! A stage that approximates says how wrong it is ([`Figures`]) and what that cost; a [`Report`]
//! holds those points as [`Series`] and leaves as JSON, CSV or one self-contained HTML page with
//! log-log plots. Nothing here knows what is being measured. The same report always gives the same
//! bytes.
//!
//! ```
//! use error_report::{Figures, Point, Report, Series};
//!
//! let figures = Figures::compare(&[1.1, 2.0], &[1.0, 2.0])?;
//! let mut series = Series::convergence("path tracing", "relMSE", "4096 spp, seed 7", 1.0);
//! series.points.push(Point::new("16 spp", 0.5, figures.rel_mse).with_samples(16.0));
//! let report = Report::new("A render").with_series(series);
//! assert_eq!(Report::from_json(&report.to_json()?)?, report);
//! assert!(report.to_html()?.contains("<svg"));
//! # Ok::<(), error_report::ReportError>(())
//! ```
//!
//! # The file format
//!
//! JSON, UTF-8. `schema` is [`SCHEMA`]; readers refuse any other major number, and ignore keys they
//! do not know.
//!
//! | key | value |
//! |---|---|
//! | `schema` | `"error-report/1"` |
//! | `title` | what was measured, in words |
//! | `about` | object of strings: machine, threads, command, whatever explains the numbers |
//! | `series[].label` | name of the method or run |
//! | `series[].metric` | name of the error figure, for example `relMSE` |
//! | `series[].reference` | what the error is measured against |
//! | `series[].order` | the error should fall as seconds<sup>-order</sup>: 1 for MSE, 0.5 for RMSE |
//! | `series[].joined` | whether the points are one method at rising cost (a line) or separate cases |
//! | `series[].points[]` | `label`, `seconds` >= 0, `error` >= 0, optional `samples`, `more` (object of numbers) |
//!
//! CSV holds one line a point: `series,metric,reference,order,joined,point,samples,seconds,error`, then one
//! column for every key of `more` in the order of their names; quoting follows RFC 4180.

mod csv;
mod error;
mod figures;
mod html;
mod plot;
mod report;

pub use error::ReportError;
pub use figures::{Figures, REL_MSE_EPSILON, TRIMMED_SHARE};
pub use html::escape;
pub use plot::{Curve, Plot, svg as plot_svg};
pub use report::{Point, Report, SCHEMA, Series};
