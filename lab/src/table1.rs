//! t
pub fn run(_p: &mut lexopt::Parser) -> Result<(), String> {
    Ok(())
}
