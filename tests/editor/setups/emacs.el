;;; What a newcomer to Emacs gets: run in examples/pocket by `scripts/check-editors'. -*- lexical-binding: t -*-

(require 'eglot)
(require 'flymake)

(defun check-wait (what is-there)
  "Waits until IS-THERE returns something, and returns it."
  (let ((left 400) found)
    (while (and (> left 0) (not (setq found (funcall is-there))))
      (accept-process-output nil 0.05)
      (setq left (1- left)))
    (or found (error "No %s" what))))

(defun check-open (file)
  "Opens a file, and waits until the server has it."
  (find-file file)
  (run-hooks 'post-command-hook) ; Eglot starts with the next command.
  (check-wait "server" #'eglot-managed-p))

(unless (fboundp 'yaml-mode)
  (define-derived-mode yaml-mode text-mode "YAML")
  (add-to-list 'auto-mode-alist '("\\.yaml\\'" . yaml-mode)))

(check-open "part.cls")
(unless (eq major-mode 'clsf-mode) (error "The mode is %s" major-mode))
(font-lock-mode 1)
(font-lock-ensure)
(goto-char (point-min))
(search-forward "\nGOTO")
(unless (eq (get-text-property (1- (point)) 'face) 'font-lock-keyword-face) (error "GOTO is not coloured"))

;; The server knows nothing of a program before it has read it.
(defun check-hover ()
  (let ((asked (list :textDocument (list :uri (concat "file://" buffer-file-name)) :position '(:line 19 :character 2))))
    (plist-get (plist-get (jsonrpc-request (eglot-current-server) :textDocument/hover asked) :contents) :value)))
(unless (string-match-p "1200 MMPM" (check-wait "state at a line" #'check-hover)) (error "Hover says %S" (check-hover)))
(let ((outline (format "%S" (funcall imenu-create-index-function))))
  (unless (and (string-match-p "POCKET_ROUGH" outline) (string-match-p "HOLES" outline)) (error "Outline %s" outline)))
(goto-char (point-min))
(forward-char 11)
(eglot-rename "POCKET_1")
(check-wait "new name" (lambda () (string-prefix-p "TOOL PATH/POCKET_1," (buffer-string))))

(goto-char (point-min))
(search-forward "1200")
(replace-match "12O0")
(save-buffer)
(check-wait "finding while typing"
            (lambda ()
              (flymake-start)
              (seq-find (lambda (found) (string-match-p "CL0003" (flymake-diagnostic-text found))) (flymake-diagnostics))))
(compile compile-command)
(check-wait "end of the check" (lambda () (not compilation-in-progress)))
(with-current-buffer "*compilation*"
  (goto-char (point-min))
  (compilation-next-error 1)
  (unless (looking-at-p ".*part\\.cls:17:13: CL0003") (error "The first place of the check is not known")))

(check-open "recipe.yaml")
