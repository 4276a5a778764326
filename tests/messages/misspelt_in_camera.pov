camera { loaction -5*z look_at 0 }
sphere { 0, 1 }
