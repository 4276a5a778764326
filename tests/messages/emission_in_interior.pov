// mistake in line 2: words of media in an interior
sphere { 0, 1 hollow interior { emission rgb 1 absorption 0.5 } }
