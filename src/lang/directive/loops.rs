//! Loops: `#while` and `#for`.

use crate::base::args::{Args, Parse};
use crate::base::source::{Diagnostic, Span};
use crate::lang::expr::value::{Number, Value};
use crate::lang::frame::{Entered, For, Frame, Start};
use crate::lang::limits::EQUAL;
use crate::lang::reader::Reader;
use crate::lang::syntax::Tokens;
use std::rc::Rc;

impl Reader<'_> {
    pub(crate) fn run_while(&mut self, index: usize) -> Parse<()> {
        let home = Rc::clone(&self.here.tokens);
        let (_, end) = self.group(index);
        self.count_round(index, end, Start::of(&home, index))?;
        self.look_for_change(&home, index)?;
        if self.condition()? {
            return Ok(());
        }
        self.stay_in(&home, home.span(index))?;
        self.frames.pop();
        let (_, end) = self.group(index);
        self.jump(end, home.span(index))?;
        self.pass();
        Ok(())
    }

    /// At the condition of a `#while`: an error if the last round changed nothing that the next one could read.
    fn look_for_change(&mut self, home: &Tokens, index: usize) -> Parse<()> {
        let changes = self.changes + self.streams.changes();
        let Some(Frame {
            kind: Entered::While { changes: known, .. },
            ..
        }) = self.frames.last_mut()
        else {
            return Ok(());
        };
        if known.replace(changes) != Some(changes) {
            return Ok(());
        }
        let error = Diagnostic::error(
            home.span(index),
            "this loop never ends: nothing in its body changes the condition",
        );
        let hint = "Change a value that its condition depends on, or exit with `#break`.";
        Err(self.with_trace(error.with_hint(hint)))
    }

    pub(crate) fn run_for(&mut self, index: usize, span: Span) -> Parse<()> {
        self.expect_mark('(', "`(` after `#for`")?;
        self.pass_hash_of_new_name();
        self.peek()?;
        let variable = self.identifier("a variable after `#for (`")?;
        self.take_mark(',')?;
        if !self.begins_number()? {
            return Err(self.expected_here("`,` and the start of `#for`"));
        }
        let start = self.float()?;
        self.take_mark(',')?;
        let end = self.float()?;
        self.take_mark(',')?;
        let step = self.float_or(1.0)?;
        self.expect_mark(')', "`)` at the end of `#for`")?;
        if step.abs() < EQUAL {
            return Err(self.with_trace(Diagnostic::error(span, "the step of `#for` is zero")));
        }
        let run = For {
            body: self.here.at,
            variable,
            start,
            value: start,
            end,
            step,
        };
        // The variable is local to the macro or file, even if an outer one has its name.
        self.scopes
            .local(variable, Value::Number(Number::float(start)));
        if run.is_over() {
            let (_, end) = self.group(index);
            self.jump(end, span)?;
            self.pass();
        } else {
            self.enter(index, Entered::For(Box::new(run)));
        }
        Ok(())
    }

    /// Counts the tokens from `from` to the `#end` of a loop, which are read again.
    pub(crate) fn count_round(&mut self, from: usize, end: u32, at: Start) -> Parse<()> {
        let end = (end as usize).min(self.here.tokens.tokens.len());
        self.count_reread(end.saturating_sub(from), at)
    }
}

#[cfg(test)]
mod tests {
    use crate::base::options::ReadOptions;
    use crate::base::source::{Severity, Sources};
    use crate::lang::evaluate;

    fn errors(text: &str) -> Vec<String> {
        let mut sources = Sources::new(Vec::new());
        let file = sources.add_text("test.pov", format!("#version 3.7;\n{text}"));
        let mut options = ReadOptions::default();
        options.max_repeated_tokens = options.max_repeated_tokens.min(5_000_000);
        let reading = evaluate(file, &mut sources, &options);
        let is_error =
            |finding: &&crate::base::source::Diagnostic| finding.severity == Severity::Error;
        let errors = reading.findings.iter().filter(is_error);
        errors.map(|error| error.message.clone()).collect()
    }

    #[test]
    fn a_loop_that_changes_nothing_is_left_after_one_round() {
        for text in [
            "#while (1) sphere { 0, 1 } #end",
            "#declare I = 0; #while (I < 9) sphere { I, 1 } #end",
            "#macro M(A) sphere { A, 1 } #end #while (1) M(2) #end",
            "#while (1) #if (0) #break #end #end",
            "union { #while (1) sphere { 0, 1 } #end }",
            "#while (rand(seed(1)) < 0.999) #end",
            "#declare S = seed(1); #while (rand(seed(rand(seed(2)))) < 2) sphere { 0, 1 } #end",
            "#macro R(N) rand(seed(N)) #end #while (R(1) < 2) #if (R(2) > 2) #break #end #end",
        ] {
            let expected = ["this loop never ends: nothing in its body changes the condition"];
            assert_eq!(errors(text), expected, "{text}");
        }
    }

    #[test]
    fn a_loop_may_draw_at_random_call_macros_and_break() {
        for text in [
            "#declare S = seed(1); #while (rand(S) < .9) sphere { 0, 1 } #end",
            "#declare S = seed(1); #while (1) #if (rand(S) > .9) #break #end #end",
            "#macro M() #declare I = I + 1; #end #declare I = 0; #while (I < 9) M() #end",
            "#declare N = 0*x; #declare O = sphere { 0, 1 } #declare D = trace(O, -3*z, z, N);
             #while (1) sphere { 0, 1 } #break #end",
            "#for (I, 0, 3) #while (1) #break #end #end",
            "#while (seed(1) < 20) #end",
            "#while (rand(seed(1)) < 2) #if (seed(2) > 9) #break #end #end",
            "#while (rand(seed(1) - seed(1) + 1) < 2) #if (seed(2) > 9) #break #end #end",
            "#declare S = seed(1); #while (rand(seed(1000*rand(S))) < 0.9) #end",
            "#declare A = rand(seed(1)); #while (1) #if (rand(0) > 0.9) #break #end #end",
            "#declare A = rand(seed(1)); #while (rand(seed(1)*0) < 0.9) #end",
        ] {
            assert_eq!(errors(text), [""; 0], "{text}");
        }
    }

    /// Each round opens a stream; the time of a round must not grow with their number.
    #[test]
    fn a_loop_that_opens_streams_without_end_is_stopped() {
        let expected = "the loops and macros of this scene do not come to an end";
        for text in [
            "#while (1) #local A = seed(1); #end",
            "#while (seed(1) >= 0) #end",
        ] {
            let errors = errors(text);
            assert!(errors[0].starts_with(expected), "{text}: {errors:?}");
        }
    }
}
