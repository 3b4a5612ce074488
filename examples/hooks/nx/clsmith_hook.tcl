# Runs clsmith at the end of NX's CLSF output: source this file as the last line of the event handler (.tcl) of the CLSF format.
#
#     source "S:/cam/clsmith/clsmith_hook.tcl"
#
# Set these before, or change them here. Both are lists: a path with blanks is one element. `{}` is the corrected program;
# no argument may begin with < > | & or 2>, which Tcl's exec takes for itself.
if {![info exists ::clsmith_hook]} {
    set ::clsmith_hook [list clsmith hook --select S:/cam/clsmith/recipes.yaml --log S:/cam/clsmith/hook.jsonl --timeout 600]
}
if {![info exists ::clsmith_post]} {
    set ::clsmith_post [list C:/posts/mypost.exe \{\}]
}

# The file that NX has written: directory and name without suffix, as NX sets them before the first event.
proc clsmith_output_file {} {
    global mom_output_file_directory mom_output_file_basename mom_output_file_suffix ptp_file_name
    # Handlers made from ugpost_base.tcl know it.
    if {[info exists ptp_file_name] && $ptp_file_name ne ""} {
        return $ptp_file_name
    }
    set name $mom_output_file_basename
    if {[info exists mom_output_file_suffix] && $mom_output_file_suffix ne ""} {
        set end ".[string trimleft $mom_output_file_suffix .]"
        if {![string equal -nocase [file extension $name] $end]} {
            append name $end
        }
    }
    return [file join $mom_output_file_directory $name]
}

# For the user: NX's information window, or standard output under tclsh.
proc clsmith_say {text} {
    if {[llength [info commands MOM_output_to_listing_device]]} {
        MOM_output_to_listing_device $text
    } else {
        puts $text
    }
}

proc clsmith_run {} {
    global clsmith_hook clsmith_post errorCode
    set file [clsmith_output_file]
    # What NX still holds back must be in the file first. A file that is closed already is no error.
    if {[llength [info commands MOM_close_output_file]]} {
        catch {MOM_close_output_file $file}
    }
    set command [concat $clsmith_hook [list $file --] $clsmith_post]
    set code 0
    if {[catch {eval exec [list --] $command [list 2>@1]} text]} {
        set code [lindex $errorCode end]
        if {[lindex $errorCode 0] eq "CHILDSTATUS"} {
            # Tcl adds a line of its own to what the program printed.
            regsub {\n?child process exited abnormally$} $text "" text
        }
    }
    if {$text ne ""} {
        clsmith_say $text
    }
    if {$code ne "0"} {
        set text "clsmith hook ended with $code: do not use the NC program of [file tail $file]"
        clsmith_say $text
        if {[llength [info commands MOM_abort]]} {
            MOM_abort $text
        }
        error $text
    }
}

# After everything that the handler itself does at the end of the program.
if {[llength [info procs MOM_end_of_program]] && ![llength [info procs clsmith_end_of_program]]} {
    rename MOM_end_of_program clsmith_end_of_program
}
proc MOM_end_of_program {} {
    if {[llength [info procs clsmith_end_of_program]]} {
        # In the caller's scope, for handlers that rely on it.
        uplevel 1 clsmith_end_of_program
    }
    clsmith_run
}
