// mistake in line 2: a misspelt word in `camera`
camera { loaction -5*z look_at 0 }
sphere { 0, 1 }
